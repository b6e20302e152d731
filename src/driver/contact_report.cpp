#include "driver/contact_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pounding {

void print_contact(const Contact& contact, const interactions::InterfaceReport& report,
                   const JointGaps* gaps) {
  std::printf(
      "\ncontact %s: %d pairs (%d node to node), %d secondary nodes face nothing, initial gap "
      "%.4g to %.4g mm, normal (%.3g, %.3g, %.3g)\n",
      report.contact.c_str(), report.pairs, report.matched, report.unmatched_nodes,
      1000 * report.smallest_gap, 1000 * report.largest_gap, report.normal[0], report.normal[1],
      report.normal[2]);
  if (gaps != nullptr) {
    std::printf("  gap at rest %.4g to %.4g mm, unloaded %.4g to %.4g mm\n",
                1000 * gaps->at_rest[0], 1000 * gaps->at_rest[1], 1000 * gaps->unloaded[0],
                1000 * gaps->unloaded[1]);
  }
  if (contact.gap_assumed_so) {
    std::printf(
        "  the gap given is that at rest (earlier versions took it for that of the unloaded "
        "meshes); "
        "-%s_gap_at rest or unloaded tells which\n",
        report.contact.c_str());
  }
  if (report.carried > 0) {
    std::printf("  %d more nodes are held by those of the face that they follow in a tie\n",
                report.carried);
  }
  const auto [secondary, primary] = report.half_thickness;
  if (secondary > 0 || primary > 0) {
    std::printf(
        "  of the meshes %.4g to %.4g mm between surfaces, half a thickness off: %.4g and "
        "%.4g mm\n",
        1000 * report.geometric_gap[0], 1000 * report.geometric_gap[1], 1000 * secondary,
        1000 * primary);
  }
  if (report.filler_area > 0) {
    const auto [least, most] = report.filler_thickness;
    std::printf("  filler of %.4g m2, %.4g to %.4g mm thick, in the gap\n", report.filler_area,
                1000 * least, 1000 * most);
  }
}

void print_impacts(const Scene& scene, const RunStatistics& statistics,
                   const ImpactCatalogue& impacts) {
  if (scene.contacts.empty()) return;
  std::printf(
      "\nimpacts: %d episodes, total impulse %.1f N s, largest %.1f N s, penetration at most "
      "%.2e m\n",
      statistics.all_impacts.episodes, statistics.all_impacts.total_impulse,
      statistics.all_impacts.largest_impulse, statistics.all_impacts.max_penetration);
  constexpr std::size_t shown = 20;
  if (!impacts.impacts().empty()) {
    std::printf(
        "  contact         start s  duration ms  impulse N s  kN over %.3g ms  of a step  points  "
        "lost J\n",
        1000 * scene.force_window);
  }
  for (std::size_t i = 0; i < std::min(shown, impacts.impacts().size()); ++i) {
    const Impact& impact = impacts.impacts()[i];
    std::printf("  %-12s %10.5f %12.3f %12.2f %14.1f %10.1f %7d %7.2f\n",
                scene.contacts[impact.contact].name.c_str(), impact.start, 1000 * impact.duration(),
                impact.impulse, impact.window_force / 1000, impact.peak_force / 1000, impact.points,
                impact.energy_lost);
  }
  if (impacts.impacts().size() > shown) {
    std::printf("  ... and %zu more in impacts.csv\n", impacts.impacts().size() - shown);
  }
}

void print_fillers(const Scene& scene, const RunStatistics& statistics) {
  for (std::size_t c = 0; c < statistics.fillers.size(); ++c) {
    if (!scene.contacts[c].filler) continue;
    const interactions::FillerTotals& filler = statistics.fillers[c];
    std::printf(
        "  %-12s filler pressed by at most %.4g kPa, %.4g kN in all, crushed by %.3g %%, "
        "took %.4g J\n",
        scene.contacts[c].name.c_str(), filler.peak_pressure / 1000, filler.peak_force / 1000,
        100 * filler.crushed_strain, filler.loss);
  }
}

void print_loops(const RunStatistics& statistics) {
  for (const LoopReport& loop : statistics.loops) {
    const interactions::LinkTotals most = loop.whole();
    std::printf(
        "  %-12s %.0f of %zu links yielded, elongation at most %.4g mm (or mrad), force %.4g "
        "kN (or kN m), took %.4g J\n",
        loop.name.c_str(), most.yielded, loop.links.size(), 1000 * most.largest_elongation,
        most.largest_force / 1000, most.work);
  }
}

void print_closings(const Scene& scene, const RunStatistics& statistics) {
  const bool apart = statistics.all_impacts.episodes == 0;
  for (std::size_t c = 0; c < statistics.closings.size(); ++c) {
    const JointClosing& joint = statistics.closings[c];
    std::printf("  %-12s closed by at most %.4g mm in the samples", scene.contacts[c].name.c_str(),
                1000 * joint.largest);
    if (apart && std::isfinite(joint.factor)) {
      std::printf("; if all stays linear, a motion %.4g times as strong closes it", joint.factor);
    }
    std::printf("\n");
  }
}

void print_slides(const Scene& scene, const RunStatistics& statistics) {
  for (std::size_t c = 0; c < statistics.slides.size(); ++c) {
    const Slide& slide = statistics.slides[c];
    std::printf("  %-12s slid along itself by at most %.4g mm", scene.contacts[c].name.c_str(),
                1000 * slide.distance);
    if (scene.contacts[c].sliding > 0) {
      std::printf(", of %.4g mm within which pairs are found anew",
                  1000 * scene.contacts[c].sliding);
    } else if (slide.facet_size > 0) {
      std::printf(", on a facet of %.4g mm", 1000 * slide.facet_size);
    }
    std::printf("\n");
  }
}

void print_contact_ratios(const Scene& scene, const RunStatistics& statistics) {
  for (std::size_t s = 0; s < statistics.contact_ratios.size(); ++s) {
    const ContactRatio& ratio = statistics.contact_ratios[s];
    std::printf(
        "  %-12s contact ratio of its compression-only springs %.3f at the end, at least %.3f at "
        "%.4g s, below %.0f %% for %.4g s\n",
        scene.structures[s].name.c_str(), ratio.now, ratio.smallest, ratio.time,
        100 * ContactRatio::low, ratio.low_duration);
  }
}

}  // namespace pounding
