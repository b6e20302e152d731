#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene/option_row.h"

namespace pounding {

/// Visitor of a description that makes rows of it, those of one block.
struct RowCollector {
  OptionBlock block = OptionBlock::run;
  std::vector<OptionRow> rows;

  void operator()(std::string_view pattern, const OptionShape& shape, std::string_view help,
                  const OptionMarks& marks = {}) {
    rows.push_back({shape, marks, block, std::string(pattern), help});
  }
  template <typename Object, typename... Last>
  void operator()(std::string_view pattern, const OptionShape& shape, std::string_view help,
                  const OptionNeeds<Object>& /*needs*/, const Last&... last) {
    (*this)(pattern, shape, help, last...);
  }
  template <typename Member, typename... Rest>
  requires std::is_member_object_pointer_v<Member>
  void operator()(Member /*member*/, const Rest&... rest) { (*this)(rest...); }
  template <typename Object, typename Part>
  void part(Part Object::* /*member*/) {
    Part::describe(*this);
  }
  template <typename Part, typename... Prefix>
  void part(const Prefix&... prefix) {
    Part::describe(*this, prefix...);
  }
};

}  // namespace pounding
