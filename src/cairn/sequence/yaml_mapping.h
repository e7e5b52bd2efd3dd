// SPDX-License-Identifier: Apache-2.0
// Private to this room: it shows yaml-cpp.
#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

/// Loads a YAML or JSON file; skips OpenCV's first line `%YAML:1.0`, which is not YAML, and takes tabs in
/// JSON for blanks. Throws InputError for invalid YAML and for an empty file.
[[nodiscard]] YAML::Node load_yaml(const std::filesystem::path& path);

/// Reads one YAML mapping; every error is an InputError with a line.
class YamlMapping {
 public:
  /// Wraps a mapping. Throws InputError for keys that are not `known`; if none is known, all are accepted, as
  /// in files of other programs.
  YamlMapping(std::string file, std::string name, const YAML::Node& node,
              const std::vector<std::string>& known);

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] int line() const { return node_.Mark().line + 1; }
  [[nodiscard]] bool has(const std::string& key) const { return static_cast<bool>(node_[key]); }
  /// Tells whether the value of `key` is a mapping.
  [[nodiscard]] bool is_mapping(const std::string& key) const { return has(key) && node_[key].IsMap(); }
  /// Throws InputError unless the key exists.
  void expect(const std::string& key, const std::string& kind) const;

  /// Returns the value of `key`. Throws InputError that names `kind` if it is missing or of another type.
  template <class T>
  [[nodiscard]] T get(const std::string& key, const std::string& kind) const {
    expect(key, kind);
    const YAML::Node value = node_[key];
    try {
      return value.as<T>();
    } catch (const YAML::Exception&) {
      fail(value, fmt::format("{} for '{}'", kind, key), describe(value), "Correct the value.");
    }
  }
  [[nodiscard]] double number(const std::string& key) const;    ///< finite
  [[nodiscard]] double positive(const std::string& key) const;  ///< above 0
  /// Returns `count` finite numbers; `kind` describes them in messages.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count,
                                            const std::string& kind) const;
  /// Returns the mapping that is the value of `key`.
  [[nodiscard]] YamlMapping sub(const std::string& key, const std::vector<std::string>& known) const;

  /// Throws InputError that names the value of `key` unless the condition holds.
  void check(bool holds, const std::string& key, const std::string& expected) const;

 private:
  [[nodiscard]] static std::string describe(const YAML::Node& value);
  [[noreturn]] void fail(const YAML::Node& at, std::string expected, std::string found,
                         std::string remedy) const;
  void check_keys(const std::vector<std::string>& known) const;

  std::string file_, name_;
  YAML::Node node_;
};

}  // namespace cairn
