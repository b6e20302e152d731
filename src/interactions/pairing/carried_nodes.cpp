#include "interactions/pairing/carried_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace pounding::interactions {
namespace {

/// Shares of a carrier that are none.
constexpr double nothing = 1e-9;

/// Whether a carrier displaces its follower at its own place, apart from turning it.
bool displaces(const Carrier& carrier) {
  return std::ranges::any_of(std::array{0, 7, 14},
                             [&](std::size_t k) { return std::abs(carrier.block[k]) > nothing; });
}

}  // namespace

std::vector<char> carried_nodes(const GlobalMesh& mesh, const ContactFace& face,
                                const std::vector<char>& has_row) {
  std::map<GlobalIndex, std::size_t> number;
  for (std::size_t i = 0; i < face.nodes.size(); ++i) number[face.nodes[i]] = i;
  std::vector<char> carried(face.nodes.size(), 0);
  for (const RigidNodes& part : mesh.rigid) {
    for (const TiedNode& tied : part.tied) {
      const auto own = number.find(tied.node);
      if (own == number.end()) continue;
      carried[own->second] = std::ranges::all_of(tied.carriers, [&](const Carrier& carrier) {
        const auto other = number.find(carrier.node);
        return mesh.free_components[carrier.node] == 0 || !displaces(carrier) ||
               (other != number.end() && has_row[other->second] != 0);
      });
    }
  }
  return carried;
}

}  // namespace pounding::interactions
