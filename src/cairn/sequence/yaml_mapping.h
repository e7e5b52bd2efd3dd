// SPDX-License-Identifier: Apache-2.0
// Private to this room: it shows yaml-cpp.
#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

/// The contents of a YAML file; OpenCV's first line `%YAML:1.0`, which is no YAML, is passed over. InputError
/// for what is no YAML and for an empty file.
[[nodiscard]] YAML::Node load_yaml(const std::filesystem::path& path);

/// Reads one YAML mapping; every error is an InputError with a line.
class YamlMapping {
 public:
  /// Keys that are not `known` are errors; with none known, all are let pass: files of others.
  YamlMapping(std::string file, std::string name, const YAML::Node& node,
              const std::vector<std::string>& known);

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] int line() const { return node_.Mark().line + 1; }
  [[nodiscard]] bool has(const std::string& key) const { return static_cast<bool>(node_[key]); }
  /// The key is there.
  void expect(const std::string& key, const std::string& kind) const;

  template <class T>
  [[nodiscard]] T get(const std::string& key, const std::string& kind) const {
    expect(key, kind);
    const YAML::Node value = node_[key];
    try {
      return value.as<T>();
    } catch (const YAML::Exception&) {
      fail(value, fmt::format("{} for '{}'", kind, key), describe(value), "Mend the value.");
    }
  }
  [[nodiscard]] double number(const std::string& key) const;    ///< finite
  [[nodiscard]] double positive(const std::string& key) const;  ///< above 0
  /// So many finite numbers; `kind` says what they are.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count,
                                            const std::string& kind) const;
  [[nodiscard]] YamlMapping sub(const std::string& key, const std::vector<std::string>& known) const;

  /// InputError that names the value of `key` unless the condition holds.
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
