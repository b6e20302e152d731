#include "interactions/pairing/absorbing_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "common/error.h"
#include "common/matrix3.h"
#include "interactions/pairing/facet_backing.h"
#include "interactions/pairing/wave_shapes.h"
#include "mesh/connectivity.h"
#include "mesh/facet_point.h"

namespace pounding::interactions {
namespace {

/// Least part of a base's normal that looks down.
constexpr double downwards = 1 - 1e-6;

/// Sums over the facets around a node [N s/m].
struct NodeSums {
  Matrix3 all{};
  Matrix3 base{};   ///< of faces through which the motion enters
  double area = 0;  ///< of these [m2]
};

[[noreturn]] void refuse(const Structure& structure, const AbsorbingFace& face,
                         const std::string& why) {
  throw UserError("option -" + structure.name +
                  (face.is_base ? "_absorbing_base " : "_absorbing ") + face.group + ": " + why);
}

std::string place_of(const GlobalMesh& mesh, const Facet& facet) {
  const Vector3 x = centroid(mesh, facet.corners());
  std::ostringstream text;
  text << "its facet at (" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

/// rho (V_p n n^T + V_s (I - n n^T)) [N s/m3].
Matrix3 impedance_per_area(const Material& material, const Vector3& n) {
  const double shear = material.young / (2 * (1 + material.poisson));
  const double across = std::sqrt(shear * material.density);
  const double along = across * std::sqrt((2 - 2 * material.poisson) / (1 - 2 * material.poisson));
  Matrix3 impedance{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      impedance[i][j] = (along - across) * n[i] * n[j] + (i == j ? across : 0);
    }
  }
  return impedance;
}

/// The outer solid behind a facet.
const Backing& solid_behind(const Structure& structure, const AbsorbingFace& face,
                            const GlobalMesh& mesh, const Facet& facet,
                            const FacetBacking& backing) {
  const auto count = std::ranges::count(backing.elements, true, &Backing::solid);
  if (facet.count < 3 || count == 0) {
    refuse(structure, face,
           place_of(mesh, facet) + " is no face of a solid; name a surface of solids");
  }
  if (count > 1) {
    refuse(structure, face,
           place_of(mesh, facet) + " lies between two solids; name a surface on the outside");
  }
  return *std::ranges::find(backing.elements, true, &Backing::solid);
}

void require_level(const Structure& structure, const AbsorbingFace& face, const GlobalMesh& mesh,
                   const Facet& facet, const Vector3& normal, double height) {
  const double near = coincidence * bounding_box({&mesh, 1}).diagonal();
  const double off = std::abs(centroid(mesh, facet.corners())[2] - height);
  if (!(-normal[2] >= downwards) || off > near) {
    refuse(structure, face,
           place_of(mesh, facet) +
               " does not look down, or lies at another height than the first; "
               "the motion enters through a level underside");
  }
}

/// The columns of the Cholesky factor of C, and the effect of a wave along them.
AbsorbingNode dashpots_of(GlobalIndex node, const NodeSums& sums) {
  Matrix3 factor{};  // lower
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double value = sums.all[i][j];
      for (std::size_t k = 0; k < j; ++k) value -= factor[i][k] * factor[j][k];
      factor[i][j] = i == j ? std::sqrt(value) : value / factor[j][j];
    }
  }
  AbsorbingNode result;
  result.node = node;
  result.incident.resize(9);
  Matrix3 forward{};  // factor^-1 (2 B)
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = k; i < 3; ++i) result.dashpot[k] += factor[i][k] * factor[i][k];
    const double length = std::sqrt(result.dashpot[k]);
    for (std::size_t i = k; i < 3; ++i) result.axis[k][i] = factor[i][k] / length;
    for (std::size_t d = 0; d < 3; ++d) {
      double value = 2 * sums.base[k][d];
      for (std::size_t i = 0; i < k; ++i) value -= factor[k][i] * forward[i][d];
      forward[k][d] = value / factor[k][k];
      result.incident[3 * k + d] = length * forward[k][d];
    }
  }
  return result;
}

void require_free(const Scene& scene, const Structure& structure, const GlobalMesh& mesh,
                  const std::map<GlobalIndex, NodeSums>& nodes) {
  const auto base = std::ranges::find_if(structure.absorbing, &AbsorbingFace::is_base);
  for (std::size_t d = 0; base != structure.absorbing.end() && d < 3; ++d) {
    const bool moves = std::ranges::any_of(nodes, [&](const auto& item) {
      return item.second.base[d][d] > 0 && (mesh.free_components[item.first] >> d & 1) != 0;
    });
    if (scene.motion[d] && !moves) {
      const std::string along = direction_names[d];
      refuse(structure, *base,
             "the whole base is clamped along " + along + ", where the motion along " + along +
                 " cannot enter; free it, or leave that motion out");
    }
  }
}

}  // namespace

AbsorbingReport find_absorbing_nodes(const Scene& scene, const Structure& structure,
                                     GlobalMesh& mesh) {
  AbsorbingReport report;
  std::map<GlobalIndex, NodeSums> nodes;
  std::set<std::set<GlobalIndex>> seen;
  std::optional<double> height;
  for (const AbsorbingFace& face : structure.absorbing) {
    const auto group = mesh.groups.find(face.group);
    if (group == mesh.groups.end() || group->second.facets.empty()) {
      refuse(structure, face,
             "no surface of solids of such a group in " + structure.mesh + " is in use");
    }
    const std::vector<Facet>& facets = group->second.facets;
    const std::vector<FacetBacking> backings = elements_behind(mesh, structure.regions, facets);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const Facet& facet = facets[f];
      const Backing& behind = solid_behind(structure, face, mesh, facet, backings[f]);
      if (!seen.insert({facet.corners().begin(), facet.corners().end()}).second) {
        refuse(structure, face, place_of(mesh, facet) + " is in two absorbing groups");
      }
      const Vector3 normal = normalised(behind.area);
      if (face.is_base) {
        if (!height) height = centroid(mesh, facet.corners())[2];
        require_level(structure, face, mesh, facet, normal, *height);
      }
      const Matrix3 impedance =
          impedance_per_area(structure.regions[behind.region].material, normal);
      const std::array<double, 4> shares = facet_shares(mesh, facet);
      for (std::size_t a = 0; a < facet.corners().size(); ++a) {
        NodeSums& sums = nodes[facet.nodes[a]];
        report.area += shares[a];
        sums.area += face.is_base ? shares[a] : 0;
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j) {
            const double value = shares[a] * impedance[i][j];
            sums.all[i][j] += value;
            sums.base[i][j] += face.is_base ? value : 0;
          }
        }
      }
    }
  }
  require_free(scene, structure, mesh, nodes);
  for (const auto& [node, sums] : nodes) {
    mesh.absorbing.push_back(dashpots_of(node, sums));
    if (sums.area == 0) continue;
    const Vector3 x = mesh.position(node);
    report.base_area += sums.area;
    report.base.insert(report.base.end(), {x[0], x[1], x[2], sums.area});
  }
  add_wave_shapes(scene.motion_incoherent, structure, mesh);
  report.nodes = static_cast<GlobalIndex>(mesh.absorbing.size());
  return report;
}

}  // namespace pounding::interactions
