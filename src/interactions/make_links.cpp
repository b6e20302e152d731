#include "interactions/make_links.h"

#include "interactions/link_rows.h"
#include "interactions/modal_dashpots.h"

namespace pounding::interactions {

std::unique_ptr<StructureLinks> make_links(const LinearSystem& system, std::size_t structure,
                                           double time_step) {
  if (ModalDashpots::are_all_links(system)) {
    return std::make_unique<ModalDashpots>(system, structure, time_step);
  }
  return std::make_unique<LinkRows>(system, structure, time_step);
}

}  // namespace pounding::interactions
