#include "system/inelastic_laws.h"

#include <array>
#include <sstream>

#include "common/error.h"
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

void require_elastic_rest(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh,
                          const std::vector<double>& displacement) {
  if (laws.empty()) return;
  const std::vector<double> all = with_ghosts(mesh, displacement);
  on_every_rank(mesh.comm, [&] {
    for (const auto& [region, law] : laws) {
      std::size_t first = 0;
      for (const ElementBlock& block : mesh.blocks) {
        if (block.region != region) continue;
        const ElementLayout layout = element_layout(block.type);
        for (std::size_t e = 0; e < block.count(); ++e) {
          std::array<double, max_element_size> u{}, f{};
          const auto dofs = stiffness::element_dofs(mesh, block, e, layout);
          const std::size_t size = layout.size();
          for (std::size_t i = 0; i < size; ++i) u[i] = dofs[i] < 0 ? 0 : all[dofs[i]];
          std::vector<double> memory(law->memory_size(), 0.0);
          law->respond(first + e, {u.data(), size}, memory, {f.data(), size});
          for (std::size_t p = 0; p < law->parts().size(); ++p) {
            const double ductility = law->part(first + e, p, memory).ductility;
            if (ductility <= 1) continue;
            std::ostringstream text;
            text << "option -preload static: " << describe_element(mesh, block, e)
                 << " of structure " << mesh.structure << " is at rest " << ductility
                 << " times beyond the first corner of its " << law->parts()[p]
                 << "; give a stronger skeleton, or leave -preload out";
            throw UserError(text.str());
          }
        }
        first += block.count();
      }
    }
  });
}

}  // namespace pounding
