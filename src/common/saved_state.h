#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pounding {

/// Saved state, from which a run can be continued: numbers by name, in memory. Whoever has a state
/// puts it in here and gets it back; `output/checkpoint.h` brings it to a file and back.
///
/// Three kinds, by how they lie on the ranks:
///   tables  known to one rank, or alike to several: the lowest rank that puts one is believed;
///           every rank gets it back
///   sums    a part per rank that add up: every rank gets its own part back on the same number of
///           ranks, else rank 0 the totals and the others zeros
///   dofs    one value per owned dof of a structure: every rank gets those of the dofs it owns
class SavedState {
 public:
  /// Rows of `columns` values; a plain vector if `columns` is 0.
  struct Table {
    std::size_t columns = 0;
    std::vector<double> values;

    static void members(auto& self, auto& stream) { stream(self.columns, self.values); }
  };
  using DofKey = std::pair<int, std::string>;  ///< structure and name

  SavedState() = default;
  /// `source`: where it comes from, for messages.
  explicit SavedState(std::string source) : source_(std::move(source)) {}

  void put(const std::string& name, std::span<const double> values, std::size_t columns = 0);
  void put(const std::string& name, std::initializer_list<double> values);
  void put_sums(const std::string& name, std::span<const double> values);
  void put_dofs(int structure, const std::string& name, std::span<const double> values);

  /// Give back the values put. Throw UserError if it is not there in that size.
  void get(const std::string& name, std::span<double> values) const;
  double number(const std::string& name) const;
  /// Refuses a value that is not a whole number.
  std::int64_t integer(const std::string& name) const { return whole(name, number(name)); }
  /// A value of `name` as a whole number.
  std::int64_t whole(const std::string& name, double value) const;
  const std::vector<double>& table(const std::string& name, std::size_t columns) const;
  void get_sums(const std::string& name, std::span<double> values) const;
  void get_dofs(int structure, const std::string& name, std::span<double> values) const;

  /// Throws UserError: the values under this name cannot be a state of this scene.
  [[noreturn]] void refuse_values(const std::string& name) const;

  /// No dof of this rank holds an infinity or a NaN.
  bool dofs_are_finite() const;

  const std::map<std::string, Table>& tables() const { return tables_; }
  const std::map<std::string, std::vector<double>>& sums() const { return sums_; }
  const std::map<DofKey, std::vector<double>>& dofs() const { return dofs_; }
  const std::string& source() const { return source_; }

 private:
  [[noreturn]] void refuse(const std::string& name) const;

  std::string source_;
  std::map<std::string, Table> tables_;
  std::map<std::string, std::vector<double>> sums_;
  std::map<DofKey, std::vector<double>> dofs_;
};

/// Rows of numbers of `count` objects: `members(i, take)` calls `take` with the members of object i
/// that make a row.
template <typename Members>
std::vector<double> numbers_of(std::size_t count, const Members& members) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    members(i,
            [&](const auto&... values) { (numbers.push_back(static_cast<double>(values)), ...); });
  }
  return numbers;
}

/// Objects as rows of numbers; `members(object, take)` likewise.
template <typename Object, typename Members>
std::vector<double> to_rows(const std::vector<Object>& objects, const Members& members) {
  return numbers_of(objects.size(),
                    [&](std::size_t i, const auto& take) { members(objects[i], take); });
}

/// Brings the numbers back into as many objects.
template <typename Object, typename Members>
void from_rows(std::span<const double> numbers, std::vector<Object>& objects,
               const Members& members) {
  auto next = numbers.begin();
  for (Object& object : objects) {
    members(object, [&](auto&... values) {
      ((values = static_cast<std::remove_reference_t<decltype(values)>>(*next++)), ...);
    });
  }
}

/// Goes over the numbers of a state by their names, to put them into a saved state or to bring them
/// back: their owner names them once.
class StateKeeper {
 public:
  /// The state must outlive this object.
  static StateKeeper to(SavedState& state) { return {&state, &state}; }
  static StateKeeper from(const SavedState& state) { return {nullptr, &state}; }

  bool puts() const { return to_ != nullptr; }
  /// This one for tables that this rank has or has not: without them it puts none.
  StateKeeper known_if(bool known) const { return {to_, from_, known}; }
  /// The state that values come from, or go to.
  const SavedState& state() const { return *from_; }

  // The three kinds of SavedState, by the same names.
  void table(const std::string& name, std::span<double> values, std::size_t columns = 0) const {
    if (!puts()) from_->get(name, values);
    if (puts() && known_) to_->put(name, values, columns);
  }
  void sums(const std::string& name, std::span<double> values) const {
    puts() ? to_->put_sums(name, values) : from_->get_sums(name, values);
  }
  void dofs(std::size_t structure, const std::string& name, std::span<double> values) const {
    const auto number = static_cast<int>(structure);
    puts() ? to_->put_dofs(number, name, values) : from_->get_dofs(number, name, values);
  }
  /// A table of single numbers; integers are refused where they are not whole.
  template <typename... Values>
  void numbers(const std::string& name, Values&... values) const {
    std::array<double, sizeof...(Values)> row{static_cast<double>(values)...};
    table(name, row);
    auto next = row.begin();
    if (!puts()) (bring(name, *next++, values), ...);
  }
  /// A table with a row for each of `count` objects: `members(i, take)` calls `take` with the
  /// numbers of object i.
  template <typename Members>
  void rows(const std::string& name, std::size_t count, const Members& members) const {
    rows_of(name, count, 0, members);
  }
  /// A row for each of some objects: `members(object, take)` calls `take` with its numbers.
  template <typename Object, typename Members>
  void rows(const std::string& name, std::vector<Object>& objects, const Members& members) const {
    rows_of(name, objects.size(), width<Object>(members),
            [&](std::size_t i, const auto& take) { members(objects[i], take); });
  }
  /// Rows of as many objects as there were.
  template <typename Object, typename Members>
  void list(const std::string& name, std::vector<Object>& objects, const Members& members) const {
    const std::size_t columns = width<Object>(members);
    if (!puts()) objects.resize(from_->table(name, columns).size() / columns);
    rows(name, objects, members);
  }

 private:
  StateKeeper(SavedState* to, const SavedState* from, bool known = true)
      : to_(to), from_(from), known_(known) {}

  template <typename Object, typename Members>
  static std::size_t width(const Members& members) {
    std::size_t columns = 0;
    Object one{};
    members(one, [&](auto&... values) { columns += sizeof...(values); });
    return columns;
  }
  template <typename Value>
  void bring(const std::string& name, double number, Value& value) const {
    if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
      value = static_cast<Value>(from_->whole(name, number));
    } else {
      value = static_cast<Value>(number);
    }
  }
  /// `columns`: of a table without rows.
  template <typename Members>
  void rows_of(const std::string& name, std::size_t count, std::size_t columns,
               const Members& members) const {
    std::vector<double> all = numbers_of(count, members);
    table(name, all, count == 0 ? columns : all.size() / count);
    auto next = all.begin();
    for (std::size_t i = 0; !puts() && i < count; ++i) {
      members(i, [&](auto&... values) { (bring(name, *next++, values), ...); });
    }
  }

  SavedState* to_;  ///< null: values are brought back
  const SavedState* from_;
  bool known_;
};

}  // namespace pounding
