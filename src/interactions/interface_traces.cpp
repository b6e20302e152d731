#include "interactions/interface_traces.h"

namespace pounding::interactions {

std::vector<std::vector<int>> dofs_by_structure(const ContactOperator& contact,
                                                std::size_t structures) {
  std::vector<std::vector<int>> dofs(structures);
  for (int i = 0; i < contact.dofs(); ++i) {
    const InterfaceDof& dof = contact.dof_list()[i];
    dofs[dof.structure].push_back(i);
  }
  return dofs;
}

std::vector<Trace> make_traces(const ContactOperator& contact,
                               std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                               bool impulses) {
  std::vector<std::vector<TracePoint>> places(systems.size());
  for (const InterfaceDof& dof : contact.dof_list()) {
    places[dof.structure].push_back({dof.node, dof.component});
  }
  std::vector<Trace> traces;
  for (std::size_t s = 0; s < systems.size(); ++s) {
    traces.emplace_back(systems[s], meshes[s], places[s], impulses);
  }
  return traces;
}

std::vector<int> known_dofs(std::span<const std::vector<int>> structure_dofs,
                            std::span<const Trace> traces) {
  std::vector<int> known;
  for (std::size_t s = 0; s < traces.size(); ++s) {
    for (const int place : traces[s].known()) known.push_back(structure_dofs[s][place]);
  }
  return known;
}

}  // namespace pounding::interactions
