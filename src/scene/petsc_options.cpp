#include "scene/petsc_options.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/nearest_name.h"
#include "scene/option_table.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

enum class Value { flag, count, integer, above_zero, solver };

struct PetscOption {
  std::string_view pattern;  ///< '*' ends a prefix
  Value value;
};

constexpr auto known_options = std::to_array<PetscOption>({
    {"log_view", Value::flag},
    {"lowest_eps_converged_reason", Value::flag},
    {"lowest_eps_max_it", Value::count},
    {"lowest_eps_monitor", Value::flag},
    {"lowest_eps_mpd", Value::count},
    {"lowest_eps_ncv", Value::count},
    {"lowest_eps_tol", Value::above_zero},
    {"lowest_eps_type", Value::solver},
    {"lowest_eps_view", Value::flag},
    {"lowest_st_mat_mumps_icntl_*", Value::integer},
    {"malloc_debug", Value::flag},
    {"malloc_dump", Value::flag},
    {"malloc_view", Value::flag},
    {"memory_view", Value::flag},
    {"no_signal_handler", Value::flag},
    {"options_left", Value::flag},
    {"rest_ksp_converged_reason", Value::flag},
    {"rest_ksp_max_it", Value::count},
    {"rest_ksp_monitor", Value::flag},
    {"rest_ksp_rtol", Value::above_zero},
    {"rest_ksp_view", Value::flag},
    {"rest_mat_mumps_icntl_*", Value::integer},
});

constexpr auto patterns = [] {
  std::array<std::string_view, known_options.size()> names;
  std::ranges::transform(known_options, names.begin(), &PetscOption::pattern);
  return names;
}();

const std::vector<std::string> eigen_solvers{"krylovschur", "arnoldi"};

bool matches(std::string_view pattern, std::string_view name) {
  return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1))
                                : name == pattern;
}

}  // namespace

std::span<const std::string_view> petsc_option_patterns() {
  return patterns;
}

bool is_petsc_option(std::string_view name) {
  return std::ranges::any_of(patterns,
                             [name](std::string_view pattern) { return matches(pattern, name); });
}

std::optional<std::string> petsc_value_fault(const std::string& name, const std::string& value) {
  const auto option = std::ranges::find_if(
      known_options, [&](const PetscOption& known) { return matches(known.pattern, name); });
  if (option == known_options.end()) return std::nullopt;
  switch (option->value) {
    case Value::flag:
      return parse_boolean(value)
                 ? std::nullopt
                 : std::optional(
                       "expected true, false or no value; it prints to the terminal, no "
                       "file can be named");
    case Value::count:
      return parse_integer(value).value_or(0) > 0 ? std::nullopt
                                                  : std::optional("expected an integer >= 1");
    case Value::integer:
      return parse_integer(value) ? std::nullopt : std::optional("expected an integer");
    case Value::above_zero:
      return parse_real(value).value_or(0) > 0 ? std::nullopt
                                               : std::optional("expected a number > 0");
    case Value::solver:
      break;
  }
  if (std::ranges::find(eigen_solvers, value) != eigen_solvers.end()) return std::nullopt;
  std::string expected = "expected one of:";
  for (const std::string& solver : eigen_solvers) expected += " " + solver;
  return expected + suggestion(value, eigen_solvers);
}

}  // namespace pounding
