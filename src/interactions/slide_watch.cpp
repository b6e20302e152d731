#include "interactions/slide_watch.h"

#include <algorithm>
#include <cmath>

#include "interactions/interface_traces.h"
#include "interactions/pairing/tangential_rows.h"

namespace pounding::interactions {
SlideWatch::SlideWatch(MPI_Comm comm, const Interface& interface,
                       std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                       int contacts)
    : operator_(comm, tangential_rows(interface.constraints), meshes),
      traces_(make_traces(operator_, systems, meshes, false)),
      gather_(comm, known_dofs(dofs_by_structure(operator_, systems.size()), traces_)),
      displacement_(static_cast<std::size_t>(operator_.dofs()), 0.0),
      slides_(static_cast<std::size_t>(contacts)) {
  std::size_t known = 0;
  for (const Trace& trace : traces_) {
    first_known_.push_back(known);
    known += trace.known().size();
  }
  mine_.assign(known, 0.0);
  for (const Constraint& constraint : interface.constraints) {
    contact_.push_back(constraint.contact);
    facet_size_.push_back(constraint.facet_size);
  }
}

void SlideWatch::set_displacement(std::size_t structure, const double* displacement,
                                  std::span<const double> supports) {
  traces_[structure].apply(displacement, mine_.data() + first_known_[structure], 1, supports);
}

void SlideWatch::look(double time) {
  gather_.gather(1, mine_, displacement_);
  for (std::size_t i = 0; i < contact_.size(); ++i) {
    const int row = 2 * static_cast<int>(i);
    const double distance =
        std::hypot(operator_.apply(row, displacement_), operator_.apply(row + 1, displacement_));
    const double size = facet_size_[i];
    Slide& slide = slides_[contact_[i]];
    if (size > 0 && distance > Slide::limit * size && slide.since < 0) slide.since = time;
    // All pairs of a contact face facets, or all a wall.
    if (size > 0 ? distance * slide.facet_size > slide.distance * size || slide.facet_size == 0
                 : distance > slide.distance) {
      slide.distance = distance;
      slide.facet_size = size;
    }
  }
}

void SlideWatch::save(SavedState& saved) const {
  std::vector<double> values;
  for (const Slide& slide : slides_) {
    values.insert(values.end(), {slide.distance, slide.facet_size, slide.since});
  }
  saved.put("contact_slide", values, 3);
}

void SlideWatch::load(const SavedState& saved) {
  std::vector<double> values(3 * slides_.size());
  saved.get("contact_slide", values);
  for (std::size_t c = 0; c < slides_.size(); ++c) {
    slides_[c] = {values[3 * c], values[3 * c + 1], values[3 * c + 2]};
  }
}

}  // namespace pounding::interactions
