// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace cairn {

/// Holds the finite numbers that a parameter accepts, and their unit. Made by `above`, `from` and the like.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();  ///< accepted itself
  const char* unit = "";             ///< "pixels", "a share"; for a text what it is: "a folder"
  const char* minimum_means = "";    ///< what the minimum does, if that is special: "off"
  bool excludes_minimum = false;     ///< the minimum itself is not accepted
  bool counts_from_minimum = false;  ///< described as "at least 1 keyframe", not as "keyframes from 1"

  /// Returns whether the value is finite and inside.
  [[nodiscard]] bool contains(double value) const;
  /// Describes the range with its unit: "pixels above 0", "a share from 0 to 1", "at least 1 keyframe".
  [[nodiscard]] std::string describe() const;
};

/// Accepts any finite number of this unit; for a text, `unit` says what it is ("a folder").
[[nodiscard]] Range any(const char* unit);
/// Accepts numbers above the minimum: "pixels above 0".
[[nodiscard]] Range above(double minimum, const char* unit);
/// Accepts numbers above the minimum, up to the maximum: "a share above 0, up to 1".
[[nodiscard]] Range above_up_to(double minimum, double maximum, const char* unit);
/// Accepts the minimum and all above: "radians from 0"; with `minimum_means` "off", "radians from 0 (off)".
[[nodiscard]] Range from(double minimum, const char* unit, const char* minimum_means = "");
/// Accepts both ends and all between: "a share from 0 to 1".
[[nodiscard]] Range from_to(double minimum, double maximum, const char* unit, const char* minimum_means = "");
/// Accepts the minimum and all above: "at least 2 frames".
[[nodiscard]] Range at_least(double minimum, const char* unit);

/// Describes one parameter. Its texts need to live as long as the visit only: a visitor copies what it keeps.
struct Parameter {
  const char* name;              ///< as files and --set have it: "tracking.map_radius_px"
  Range range;                   ///< not used for yes or no
  const char* meaning;           ///< one line for people, as in the tables of the documents
  const char* former_name = "";  ///< still accepted, with a warning; empty: none
  const char* remedy = "Leave it out for the default.";  ///< for a value out of range, a whole sentence
};

/// Describes a parameter that no longer exists, or that other programs have. A file may still set it to the
/// value that means its absence, and one of other programs to any value.
struct RetiredParameter {
  const char* name;
  const char* accepted;  ///< the value that changes nothing, e.g. "no"; empty: any value
  const char* reason;    ///< why it was removed, or is not needed, a clause: "it improved no recording"
};

/// Receives the parameters of an options struct, each once, from the struct's `visit(options, visitor)`.
class ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;
  virtual void parameter(const Parameter& parameter, double& value) = 0;
  virtual void parameter(const Parameter& parameter, int& value) = 0;
  virtual void parameter(const Parameter& parameter, bool& value) = 0;
  virtual void parameter(const Parameter& parameter, std::string& value) = 0;
  virtual void parameter(const Parameter& parameter, std::optional<double>& value) = 0;
  virtual void parameter(const Parameter& parameter, std::optional<std::int64_t>& value) = 0;
  /// Receives a parameter that was removed; ignores it unless overridden.
  virtual void retired(const RetiredParameter& parameter) { (void)parameter; }
};

/// Throws InputError that names the parameter for the first number out of its range; an optional without a
/// value is in range.
class RangeCheck : public ParameterVisitor {
 public:
  void parameter(const Parameter& parameter, double& value) override;
  void parameter(const Parameter& parameter, int& value) override;
  void parameter(const Parameter& parameter, bool& value) override;
  void parameter(const Parameter& parameter, std::string& value) override;
  void parameter(const Parameter& parameter, std::optional<double>& value) override;
  void parameter(const Parameter& parameter, std::optional<std::int64_t>& value) override;
};

/// Throws InputError that names the first parameter of the options that is out of its range. Takes a copy, as
/// `visit` could change what it visits.
template <class Options>
void check_ranges(Options options) {
  RangeCheck check;
  visit(options, check);
}

/// Throws InputError that names the parameter unless `holds`: for conditions on several parameters.
void check_parameter(bool holds, const char* name, const char* expected, double found);

}  // namespace cairn
