#pragma once

#include <span>
#include <type_traits>
#include <vector>

/// Objects as rows of a table of numbers, as they go into a saved state. `members(object, take)`
/// calls `take` with the members that make a row.
namespace pounding {

template <typename Object, typename Members>
std::vector<double> to_rows(const std::vector<Object>& objects, const Members& members) {
  std::vector<double> numbers;
  for (const Object& object : objects) {
    members(object,
            [&](const auto&... values) { (numbers.push_back(static_cast<double>(values)), ...); });
  }
  return numbers;
}

/// Reads as many objects as there are.
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

}  // namespace pounding
