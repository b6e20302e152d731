#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace pounding {

using Json = nlohmann::ordered_json;

/// Sentence of the report about the values of an object in SI: "mass {mass:.0f} kg". A slot has the
/// name of a value, or of one within it, "gap/0"; without a name it takes the next of `values`.
/// After a colon come the conversion of printf (else %lld, %g or %s) and a unit into which an SI
/// value is converted: mm, ms, %, kN, kPa or MB; the unit is behind the value unless it is in
/// brackets: "{gap:8.3f [mm]}". Two numbers are a range, "1 to 2", three a vector, "(1, 2, 3)". A
/// part of the sentence in brackets is left out where the first value in it is nothing.
std::string told(std::string_view pattern, const Json& object,
                 std::initializer_list<Json> values = {});

/// Sentence whose slots have no names.
inline std::string sentence(std::string_view pattern, std::initializer_list<Json> values) {
  return told(pattern, nullptr, values);
}

/// Whether a value is null, false, empty, 0, or a list of such.
bool is_nothing(const Json& value);

/// Entries of an object that are not nothing.
Json without_nothing(const Json& object);

/// Facts of one subject, each worked out once: values by key in SI, as summary.json has them, and
/// the sentences of the report, whose slots name the values.
struct Facts {
  Json values = Json::object();
  std::string text{};

  /// Adds a sentence about the values. `more`: those of slots without a name, for the report only.
  void say(std::string_view pattern, std::initializer_list<Json> more = {}) {
    text += told(pattern, values, more);
  }
  /// Adds a fact, and a sentence that may have it.
  void add(const std::string& key, Json value, std::string_view pattern = "") {
    values[key] = std::move(value);
    say(pattern);
  }
  /// Adds the facts of a part under a key.
  void add(const std::string& key, const Facts& part) {
    values[key] = part.values;
    text += part.text;
  }
  /// Adds the facts of one of several parts by its name under a key, and a sentence about them.
  void add(const std::string& key, const std::string& name, Json part, std::string_view pattern,
           std::initializer_list<Json> more = {}) {
    text += told(pattern, part, more);
    values[key][name] = std::move(part);
  }
  /// Adds the facts of a part beside those that are here.
  void add(const Facts& part) {
    values.update(part.values);
    text += part.text;
  }
};

/// Prints text of the report, and that of facts, on standard output.
void print(const std::string& text);
inline void print(const Facts& facts) {
  print(facts.text);
}

}  // namespace pounding
