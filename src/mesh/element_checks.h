#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "mesh/raw_mesh.h"

namespace pounding {

/// Throws UserError, naming both, where two elements lie on the same nodes: solids or shells of any
/// groups, lines and points of one group. Serial.
void check_repeated_elements(const std::string& structure, const GlobalMesh& mesh);

/// Leaves the first facet of those on the same nodes, in their order. Serial.
void drop_repeated_facets(std::vector<Facet>& facets);

/// Nodes of every element that holds the node. Serial.
std::vector<std::span<const GlobalIndex>> elements_at(const GlobalMesh& mesh, GlobalIndex node);

/// The largest distance between two nodes of an element that holds the node [m]; 0 where none has
/// an extent. Serial.
double element_size_at(const GlobalMesh& mesh, GlobalIndex node);

/// Throws UserError, naming the element, where two nodes of an element that has length, area or
/// volume lie at one place: closer than 1e-12 of the diagonal of the mesh. Serial.
void check_element_sizes(const std::string& structure, const GlobalMesh& mesh);

/// Makes one element of the copies that a file has of an element in several physical groups, one
/// per group, as format 2.2 of Gmsh writes it: on one entity, of one type, with the same nodes. The
/// first one stays. More copies than groups are left: they are another mistake.
/// Serial.
void merge_shared_elements(RawMesh& mesh);

}  // namespace pounding
