#include "common/saved_state.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace pounding {

void SavedState::put(const std::string& name, std::span<const double> values, std::size_t columns) {
  tables_[name] = {columns, {values.begin(), values.end()}};
}

void SavedState::put(const std::string& name, std::initializer_list<double> values) {
  tables_[name] = {0, values};
}

void SavedState::put_sums(const std::string& name, std::span<const double> values) {
  sums_[name].assign(values.begin(), values.end());
}

void SavedState::put_dofs(int structure, const std::string& name, std::span<const double> values) {
  dofs_[{structure, name}].assign(values.begin(), values.end());
}

void SavedState::refuse(const std::string& name) const {
  throw UserError(source_ + ": '" + name +
                  "' is missing or has another size; the file is damaged or not of this scene");
}

void SavedState::refuse_values(const std::string& name) const {
  throw UserError(source_ + ": '" + name +
                  "' holds values that no run of this scene has; the file was changed");
}

void SavedState::get(const std::string& name, std::span<double> values) const {
  const auto found = tables_.find(name);
  if (found == tables_.end() || found->second.values.size() != values.size()) refuse(name);
  std::ranges::copy(found->second.values, values.begin());
}

double SavedState::number(const std::string& name) const {
  double value = 0;
  get(name, {&value, 1});
  return value;
}

std::int64_t SavedState::whole(const std::string& name, double value) const {
  constexpr double largest = 9007199254740992;  // above it doubles leave whole numbers out
  if (!(std::abs(value) <= largest) || value != std::floor(value)) refuse_values(name);
  return static_cast<std::int64_t>(value);
}

const std::vector<double>& SavedState::table(const std::string& name, std::size_t columns) const {
  const auto found = tables_.find(name);
  if (found == tables_.end() || found->second.columns != columns) refuse(name);
  return found->second.values;
}

void SavedState::get_sums(const std::string& name, std::span<double> values) const {
  const auto found = sums_.find(name);
  if (found == sums_.end() || found->second.size() != values.size()) refuse(name);
  std::ranges::copy(found->second, values.begin());
}

void SavedState::get_dofs(int structure, const std::string& name, std::span<double> values) const {
  const auto found = dofs_.find({structure, name});
  if (found == dofs_.end() || found->second.size() != values.size()) refuse(name);
  std::ranges::copy(found->second, values.begin());
}

bool SavedState::dofs_are_finite() const {
  return std::ranges::all_of(dofs_, [](const auto& entry) {
    return std::ranges::all_of(entry.second, [](double value) { return std::isfinite(value); });
  });
}

}  // namespace pounding
