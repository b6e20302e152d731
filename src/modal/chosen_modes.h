#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "modal/orthonormal_space.h"
#include "modal/static_loads.h"

namespace pounding {

/// Numbers of `wanted` of the modes in a space, increasing: the lowest three quarters, and then
/// those that move the contact points and the other points of a request most. `squared_frequency`:
/// of each mode [1/s2]. Collective.
std::vector<std::size_t> moving_most(MPI_Comm comm, const Mesh& mesh, const ModalRequest& request,
                                     const OrthonormalSpace& space,
                                     std::span<const double> squared_frequency, std::size_t wanted);

}  // namespace pounding
