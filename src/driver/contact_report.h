#pragma once

#include "driver/model.h"
#include "driver/run_statistics.h"
#include "interactions/pairing/interface.h"
#include "output/impact_catalogue.h"
#include "scene/scene.h"

namespace pounding {

/// Parts of the report that tell of contacts, for rank 0: how each was found, its impacts, its
/// filler, the links that were recorded, how far it slid, and how long springs that press only were
/// pressed. `gaps`: where the run starts at rest, else null.
void print_contact(const Contact& contact, const interactions::InterfaceReport& report,
                   const JointGaps* gaps);
void print_impacts(const Scene& scene, const RunStatistics& statistics,
                   const ImpactCatalogue& impacts);
void print_fillers(const Scene& scene, const RunStatistics& statistics);
void print_loops(const RunStatistics& statistics);
void print_closings(const Scene& scene, const RunStatistics& statistics);
void print_slides(const Scene& scene, const RunStatistics& statistics);
void print_contact_ratios(const Scene& scene, const RunStatistics& statistics);

}  // namespace pounding
