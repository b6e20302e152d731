#include "system/elimination_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pounding {

std::optional<Elimination> eliminate(std::vector<std::set<int>> neighbours, std::size_t most) {
  Elimination result;
  result.columns.resize(neighbours.size());
  std::vector<int> left(neighbours.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<char> waits(neighbours.size(), 0);
  std::size_t entries = 0;
  for (const std::set<int>& around : neighbours) entries += around.size();
  if (entries / 2 > most) return std::nullopt;
  entries = 0;
  while (!left.empty()) {
    std::size_t smallest = std::numeric_limits<std::size_t>::max();
    for (const int v : left) {
      smallest = std::min(smallest, neighbours[v].size());
      waits[v] = 0;
    }
    std::vector<int> rest;
    for (const int v : left) {
      const std::set<int>& around = neighbours[v];
      if (waits[v] != 0 || around.size() > smallest) {
        rest.push_back(v);
        continue;
      }
      entries += around.size();
      if (entries > most) return std::nullopt;
      for (const int a : around) {
        waits[a] = 1;
        auto& others = neighbours[a];
        others.erase(v);
        others.insert(around.begin(), around.end());
        others.erase(a);
      }
      result.order.push_back(v);
      result.columns[v].assign(around.begin(), around.end());
    }
    left = std::move(rest);
  }
  return result;
}

}  // namespace pounding
