#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace pounding {

/// An order in which to eliminate the vertices of a graph, and the graph of the factor.
struct Elimination {
  std::vector<int> order;                 ///< vertex by vertex
  std::vector<std::vector<int>> columns;  ///< per vertex: those left that it is connected with then
};

/// Rounds of vertices of the smallest degree that are no neighbours of each other (multiple minimum
/// degree). `neighbours` of each vertex, symmetric, without itself. Nothing where the columns would
/// hold more than `most` entries.
std::optional<Elimination> eliminate(std::vector<std::set<int>> neighbours, std::size_t most);

}  // namespace pounding
