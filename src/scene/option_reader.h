#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/types.h"
#include "scene/option_table.h"
#include "scene/row_collector.h"
#include "scene/scene.h"

namespace pounding {

/// Reads options by the pattern of the table and the names that replace its placeholders, checks
/// kind and range, and keeps the values (given or default) as the options in force. Every method
/// throws UserError naming option, value and the expected one.
class OptionReader {
 public:
  using Names = std::vector<std::string>;

  explicit OptionReader(const OptionsDatabase& database) : database_(database) {}

  /// Reads every option that a struct describes with a member: one that is not given and has no
  /// value by default leaves its member as it is, unless it is owed.
  template <typename Object, typename... Prefix>
  void read(Object& object, const Names& names = {}, const Prefix&... prefix);
  /// Refuses every option that a struct describes, but for `except`.
  template <typename Object, typename... Prefix>
  void forbid_all(const Names& names, const std::string& why, std::string_view except = "",
                  const Prefix&... prefix) const;

  bool given(std::string_view pattern, const Names& names = {}) const;
  /// Whether it is given with another value than its default, which may be in other digits.
  bool changed(std::string_view pattern, const Names& names = {}) const;

  std::string text(std::string_view pattern, const Names& names = {});
  /// Text of a file or a folder; empty if it is "none".
  std::string path(std::string_view pattern, const Names& names = {});
  std::string choice(std::string_view pattern, const Names& names = {});
  /// Choice as a value of an enumeration, whose values are in the order of its words.
  template <typename Enumeration>
  Enumeration choice_of(std::string_view pattern, const Names& names = {}) {
    return static_cast<Enumeration>(choice_number(pattern, names));
  }
  double real(std::string_view pattern, const Names& names = {});
  int integer(std::string_view pattern, const Names& names = {});
  bool boolean(std::string_view pattern, const Names& names = {});
  /// List without empty or repeated items; `none` is the empty list.
  std::vector<std::string> list(std::string_view pattern, const Names& names = {});
  /// Numbers, each in the range; `count` of them unless 0.
  std::vector<double> reals(std::string_view pattern, const Names& names = {},
                            std::size_t count = 0);

  /// Points "x,y,z; x,y,z".
  std::vector<Vector3> points(std::string_view pattern, const Names& names = {});

  /// "option -name value: why; expected ...". In `why`, here and below, the names replace the
  /// placeholders of the pattern as well.
  [[noreturn]] void refuse(std::string_view pattern, const Names& names,
                           const std::string& why = "") const;
  void refuse_if(bool wrong, std::string_view pattern, const Names& names,
                 const std::string& why = "") const {
    if (wrong) refuse(pattern, names, why);
  }
  /// Refuses the option if it is given.
  void forbid(std::string_view pattern, const Names& names, const std::string& why) const;
  /// Refuses the options whose patterns are `head` and one of `tails`, if they are given.
  void forbid_each(std::string_view head, std::initializer_list<std::string_view> tails,
                   const Names& names, const std::string& why) const {
    for (const std::string_view tail : tails) forbid(std::string(head).append(tail), names, why);
  }

  const OptionsDatabase& database() const { return database_; }
  /// Options in force: owners in the order of reading, those of each in the order of the help.
  OptionValues in_force() const;

  /// Reads an option into a member; a choice into its place among the words, of two into a flag.
  template <typename Value>
  void take(std::string_view pattern, const Names& names, Value& member);

 private:
  /// Options in force of the block of an owner: of their rows in the table the values.
  struct Owner {
    OptionBlock block;
    Names names;
    std::map<const OptionRow*, std::string> values;
  };

  void take_text(std::string_view pattern, const Names& names, std::string& member);
  /// The value in force, trimmed.
  std::string value(std::string_view pattern, const Names& names) const;
  void keep(std::string_view pattern, const Names& names);
  /// Place of a choice among its words.
  std::size_t choice_number(std::string_view pattern, const Names& names);

  const OptionsDatabase& database_;
  std::vector<Owner> in_force_;
};

/// Words of a refusal: "goes with -name value, which is not given"; the value only where it counts.
std::string goes_with(std::string_view pattern, const std::string& value = "");

/// Visitor of a description that reads into the members of an object.
template <typename Object>
class MemberReader {
 public:
  MemberReader(OptionReader& options, const OptionReader::Names& names, Object& object)
      : options_(options), names_(names), object_(object) {}

  template <typename Value, typename... Last>
  void operator()(Value Object::*member, std::string_view pattern, const OptionShape& /*shape*/,
                  std::string_view /*help*/, const Last&... last) {
    if ((applies(pattern, last) && ...)) options_.take(pattern, names_, object_.*member);
  }
  template <typename Part, typename Value, typename... Last>
  void operator()(Part Object::*part, Value Part::*member, std::string_view pattern,
                  const OptionShape& /*shape*/, std::string_view /*help*/, const Last&... last) {
    if ((applies(pattern, last) && ...)) options_.take(pattern, names_, object_.*part.*member);
  }
  template <typename... Last>
  void operator()(std::string_view /*pattern*/, const Last&... /*last*/) {}
  template <typename Part>
  void part(Part Object::*member) {
    options_.read(object_.*member, names_);
  }
  template <typename Part, typename... Prefix>
  void part(const Prefix&... /*prefix*/) {}

 private:
  bool applies(std::string_view /*pattern*/, const OptionMarks& marks) const {
    if constexpr (requires { object_.family(); }) {
      return marks.families.empty() || marks.families.contains(object_.family());
    }
    return true;
  }
  bool applies(std::string_view pattern, const OptionNeeds<Object>& needs) const {
    if ((object_.*needs.holds)()) return true;
    if (!needs.why.empty()) options_.forbid(pattern, names_, std::string(needs.why));
    return false;
  }

  OptionReader& options_;
  const OptionReader::Names& names_;
  Object& object_;
};

template <typename Object, typename... Prefix>
void OptionReader::read(Object& object, const Names& names, const Prefix&... prefix) {
  MemberReader<Object> reader(*this, names, object);
  Object::describe(reader, prefix...);
}

template <typename Object, typename... Prefix>
void OptionReader::forbid_all(const Names& names, const std::string& why, std::string_view except,
                              const Prefix&... prefix) const {
  RowCollector collector;
  Object::describe(collector, prefix...);
  for (const OptionRow& row : collector.rows) {
    if (row.pattern != except) forbid(row.pattern, names, why);
  }
}

template <typename Value>
void OptionReader::take(std::string_view pattern, const Names& names, Value& member) {
  const OptionRow& row = option_row(pattern);
  const bool owed = row.preset.has_value || row.preset.text.starts_with("required");
  if (!owed && !given(pattern, names)) return;
  if constexpr (std::is_enum_v<Value>) {
    member = choice_of<Value>(pattern, names);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    take_text(pattern, names, member);
  } else if constexpr (std::is_same_v<Value, bool>) {
    member = row.kind == OptionKind::choice ? choice_number(pattern, names) == 1
                                            : boolean(pattern, names);
  } else if constexpr (std::is_same_v<Value, int>) {
    member = row.kind == OptionKind::choice ? static_cast<int>(choice_number(pattern, names))
                                            : integer(pattern, names);
  } else if constexpr (std::is_same_v<Value, double>) {
    member = real(pattern, names);
  } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
    member = list(pattern, names);
  } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
    member = reals(pattern, names);
  } else if constexpr (std::is_same_v<Value, std::vector<Vector3>>) {
    member = points(pattern, names);
  } else if constexpr (requires { member.emplace(); }) {
    take(pattern, names, member.emplace());
  } else {
    std::ranges::copy(reals(pattern, names, member.size()), member.begin());
  }
}

/// Factor by which a study varies the damping of a structure that is otherwise the same: its
/// readers multiply their values by it.
double read_damping_factor(OptionReader& options, const std::string& structure);

}  // namespace pounding
