#include "system/inelastic_laws.h"

#include <array>
#include <span>

#include "common/parallel.h"
#include "system/axial_forces.h"
#include "system/cracking_shells.h"
#include "system/each_element.h"
#include "system/yielding_beams.h"
#include "system/yielding_shells.h"

namespace pounding {
namespace {

std::shared_ptr<interactions::ElementLaw> law_of_region(const Structure& structure,
                                                        const Mesh& mesh, int region) {
  const Region& own = structure.regions[static_cast<std::size_t>(region)];
  if (!is_shell(own.element)) return yielding_beams(structure, mesh, region);
  return own.yielding_shell.cracking ? cracking_shells(structure, mesh, region)
                                     : yielding_shells(structure, mesh, region);
}

/// Calls `visit(law, number of the element in its law, dofs)` with every element of this rank that
/// follows a law.
template <typename Visit>
void for_each_law_element(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh,
                          Visit&& visit) {
  for (const auto& [region, law] : laws) {
    std::size_t element = 0;
    for (const ElementBlock& block : mesh.blocks) {
      if (block.region != region) continue;
      const ElementLayout layout = element_layout(block.type);
      for (std::size_t e = 0; e < block.count(); ++e, ++element) {
        const auto dofs = stiffness::element_dofs(mesh, block, e, layout);
        visit(*law, element, {dofs.data(), static_cast<std::size_t>(layout.size())});
      }
    }
  }
}

}  // namespace

std::vector<interactions::RegionLaw> inelastic_laws(const Structure& structure, const Mesh& mesh) {
  std::vector<interactions::RegionLaw> laws;
  for (std::size_t r = 0; r < structure.regions.size(); ++r) {
    if (!structure.regions[r].inelastic) continue;
    const auto region = static_cast<int>(r);
    on_every_rank(mesh.comm, [&] {
      laws.push_back({region, law_of_region(structure, mesh, region)});
    });
  }
  return laws;
}

std::vector<char> dofs_of_laws(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh) {
  if (laws.empty()) return {};
  std::vector<char> acted_on(mesh.owned_dofs, 0);
  for_each_law_element(laws, mesh,
                       [&](const interactions::ElementLaw& law, std::size_t element,
                           std::span<const LocalIndex> dofs) {
                         for (std::size_t i = 0; i < dofs.size(); ++i) {
                           const bool owned = dofs[i] >= 0 && dofs[i] < mesh.owned_dofs;
                           if (owned && law.acts_on(element, i)) acted_on[dofs[i]] = 1;
                         }
                       });
  return acted_on;
}

std::vector<double> forces_of_laws(const std::vector<interactions::RegionLaw>& laws,
                                   const Mesh& mesh, const std::vector<double>& displacement) {
  std::vector<double> forces(mesh.owned_dofs, 0.0);
  if (laws.empty()) return forces;
  const std::vector<double> all = with_ghosts(mesh, displacement);
  for_each_law_element(
      laws, mesh,
      [&](const interactions::ElementLaw& law, std::size_t element,
          std::span<const LocalIndex> dofs) {
        std::array<double, max_element_size> u{}, g{};
        for (std::size_t i = 0; i < dofs.size(); ++i) u[i] = dofs[i] < 0 ? 0 : all[dofs[i]];
        std::vector<double> memory(law.memory_size(), 0.0);
        law.respond(element, {u.data(), dofs.size()}, memory, {g.data(), dofs.size()});
        for (std::size_t i = 0; i < dofs.size(); ++i) {
          if (dofs[i] >= 0 && dofs[i] < mesh.owned_dofs) forces[dofs[i]] += g[i];
        }
      });
  return forces;
}

}  // namespace pounding
