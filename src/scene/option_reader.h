#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/types.h"
#include "scene/option_table.h"
#include "scene/scene.h"

namespace pounding {

/// Reads options by the pattern of the table and the names that replace its placeholders, checks
/// kind and range, and keeps the values (given or default) as the options in force. Every method
/// throws UserError naming option, value and the expected one.
class OptionReader {
 public:
  using Names = std::vector<std::string>;

  explicit OptionReader(const OptionsDatabase& database) : database_(database) {}

  bool given(std::string_view pattern, const Names& names = {}) const;

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

  /// "option -name value: why; expected ...".
  [[noreturn]] void refuse(std::string_view pattern, const Names& names,
                           const std::string& why = "") const;
  /// Refuses the option if it is given.
  void forbid(std::string_view pattern, const Names& names, const std::string& why) const;

  const OptionsDatabase& database() const { return database_; }
  /// Options in force, in the order of reading.
  const std::vector<std::pair<std::string, std::string>>& in_force() const { return in_force_; }

 private:
  /// The value in force, trimmed.
  std::string value(std::string_view pattern, const Names& names) const;
  void keep(std::string_view pattern, const Names& names);
  /// Place of a choice among its words.
  std::size_t choice_number(std::string_view pattern, const Names& names);

  const OptionsDatabase& database_;
  std::vector<std::pair<std::string, std::string>> in_force_;
};

/// Factor by which a study varies the damping of a structure that is otherwise the same: its
/// readers multiply their values by it.
double read_damping_factor(OptionReader& options, const std::string& structure);

/// The factor on the stiffness of a structure whose other options are read. Its regions get it at
/// full order; frequencies and regions of a reduction get it once the basis is known. Throws
/// UserError where part of the stiffness would not follow: links, soil, files of matrices, P-Delta,
/// absorbing faces of a reduction.
double read_stiffness_factor(OptionReader& options, Structure& structure);

/// Multiplies Young's moduli and springs of a structure's regions.
void scale_stiffness(double factor, Structure& structure);

}  // namespace pounding
