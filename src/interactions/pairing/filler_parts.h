#pragma once

#include <span>
#include <vector>

#include "interactions/pairing/contact_face.h"
#include "interactions/pairing/interface.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Part of a face that is nearest to each of its nodes: an equal share of the area of every facet
/// around it [m2], of a line of its length [m].
std::vector<double> node_areas(const ContactFace& face);

/// Lays the filler of a contact into the joint between its pairs, whose initial gap is the joint's
/// width until then and that of hard contact afterwards. `common`: area of the filler where none is
/// told [m2], shared out in proportion to what the pairs' fillers have of it so far. `lines`: some
/// face holds lines, which have no area. Throws UserError where that is not given, where faces have
/// none in common, where a joint is closed, and where it is thinner than its filler.
void lay_filler(const Contact& contact, bool lines, double common,
                std::span<Constraint> constraints, InterfaceReport& report);

/// Lays the filler into the joint at one pair, whose part of its area is known, or the spring of a
/// stop that gives way. Throws UserError where a filled joint is closed, or thinner than its
/// filler.
void fill_joint(const Contact& contact, Constraint& constraint);

}  // namespace pounding::interactions
