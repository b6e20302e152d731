#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "common/facts.h"

namespace pounding {

/// A list that lines of doubt are added to, each about one thing that a user should look at. The
/// program prints them with "warning: " before them and lists them in summary.json.
class Doubts {
 public:
  Doubts(std::vector<std::string>& lines) : lines_(lines) {}

  /// Adds a doubt: a sentence, whose slots have no names.
  void say(std::string_view pattern, std::initializer_list<Json> values = {}) const {
    lines_.push_back(sentence(pattern, values));
  }
  /// Adds a doubt: where it is, and a sentence about that.
  void add(const std::string& where, std::string_view pattern,
           std::initializer_list<Json> values = {}) const {
    lines_.push_back(where + ": " + sentence(pattern, values));
  }
  void add(const std::vector<std::string>& lines) const {
    lines_.insert(lines_.end(), lines.begin(), lines.end());
  }

 private:
  std::vector<std::string>& lines_;
};

}  // namespace pounding
