#pragma once

#include "modal/modal_basis.h"
#include "support/box_mesh.h"
#include "system/finite_element_system.h"

namespace pounding::testing_support {

/// A brick of concrete that reaches from x = 0 to x = 2, on one rank, and places on its far face.
struct ReducedBox {
  Structure structure = solid_structure("box", 30e9, 0.2, 2400);
  Mesh mesh;
  LinearSystem system;
  ModalRequest request;

  explicit ReducedBox(bool clamped) {
    GlobalMesh global = box_mesh({0, 0, 0}, {2, 1, 0.5}, {4, 3, 2});
    if (clamped) {
      clamp(global, "x_min");
    }
    const Partition partition = partition_meshes({&global, 1}, {}, 1);
    mesh = distribute_mesh(MPI_COMM_SELF, "box", global, partition, 0);
    system = pounding::build_system(structure, mesh);
    for (const GlobalIndex node : global.groups.at("x_max").nodes) {
      request.contact_points.push_back({node, 0});
    }
    request.other_points = {{global.groups.at("x_max").nodes.front(), 1},
                            {global.groups.at("x_min").nodes.front(), 0}};
  }

  ModalBasis basis(int modes, bool attachment = true, int candidates = 0) {
    request.modes = modes;
    request.candidates = candidates;
    request.attachment = attachment;
    return compute_modal_basis(system, mesh, request);
  }

  std::size_t dof(const TracePoint& point) const {
    return static_cast<std::size_t>(mesh.dof(mesh.owned_node(point.node), point.component));
  }
};

}  // namespace pounding::testing_support
