// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/parameter.h"
#include "cairn/sequence/parameter_table.h"
#include "cairn/sequence/settings.h"

namespace cairn {

/// Holds names bound to the fields of options structs: one place that reads them, checks their type and
/// writes them back. Filled by `visit(options, table)`; the options must live as long.
class SettingTable : public ParameterVisitor {
 public:
  void parameter(const Parameter& parameter, double& value) override;
  void parameter(const Parameter& parameter, int& value) override;
  void parameter(const Parameter& parameter, bool& value) override;  ///< yes, no, true, false, on, off, 1, 0
  void parameter(const Parameter& parameter, std::string& value) override;
  void parameter(const Parameter& parameter, std::optional<double>& value) override;
  void parameter(const Parameter& parameter, std::optional<std::int64_t>& value) override;
  void retired(const RetiredParameter& parameter) override;

  /// Sets the field that the setting names; a field keeps its value if an error is thrown. Returns a warning
  /// for a person if the name is a former one or that of a retired parameter, else an empty text. Throws
  /// InputError with file and line for an unknown name, naming the nearest known one, for a value of another
  /// type (of a line `key=value` counts what stands before the first blank, semicolon or character beyond
  /// ASCII, unless a number follows), and for a retired parameter that is set to anything but the accepted
  /// value.
  [[nodiscard]] std::string apply(const Setting& setting) const;
  /// Tells whether `name` is that of a parameter, a former one or that of a retired one.
  [[nodiscard]] bool knows(const std::string& name) const;
  /// Returns all names with their present values as YAML that read_settings reads; leaves out fields without
  /// a value.
  [[nodiscard]] std::string format() const;
  /// Returns a row of name, present value, accepted values and meaning for each parameter.
  [[nodiscard]] std::vector<ParameterRow> rows() const;

 private:
  struct Entry {
    ParameterRow row;         // without its value
    std::string former_name;  // empty: none
    std::string expected;     // the kind of value, for messages
    bool is_text = false;
    bool is_word = false;                         // a text without blanks
    std::function<bool(const std::string&)> set;  // false: not of that kind
    std::function<std::string()> value;           // empty: none
  };
  struct Retired {
    std::string name, accepted, reason;
  };

  Entry& add(const Parameter& parameter, const std::string& expected,
             std::function<bool(const std::string&)> set, std::function<std::string()> value);
  [[nodiscard]] const Entry* find(const std::string& name) const;
  [[nodiscard]] static bool set(const Entry& entry, const Setting& setting);
  [[nodiscard]] static std::string apply_retired(const Retired& retired, const Setting& setting);
  [[nodiscard]] const Retired* find_retired(const std::string& name) const;
  [[noreturn]] void fail_unknown(const Setting& setting) const;

  std::vector<Entry> entries_;
  std::vector<Retired> retired_;
};

}  // namespace cairn
