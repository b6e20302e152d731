#include "interactions/pairing/contact_checks.h"

#include <sstream>

#include "common/error.h"

namespace pounding::interactions {
namespace {

// Shares of the model's longest side.
constexpr double round_off = 1e-9;         ///< an overlap below is none
constexpr double deepest_overlap = 0.002;  ///< deeper ones were not meant
constexpr double other_unit = 0.5;         ///< by which a gap given may exceed that of the meshes

/// Checks one contact.
class ContactCheck {
 public:
  ContactCheck(const Contact& contact, const InterfaceReport& report, double model_size,
               std::vector<std::string>& warnings)
      : contact_(contact), report_(report), model_size_(model_size), warnings_(warnings) {}

  void check_gaps() {
    if (contact_.stop) return;  // nodes have no surfaces, and may be parts of one structure
    check_overlap();
    if (!contact_.gap.is_of_meshes()) check_given_gap();
  }

  void check() {
    check_gaps();
    if (contact_.stop) return;
    if (contact_.primary.structure == contact_.secondary.structure) {
      warn() << "both sides belong to structure " << contact_.secondary.structure
             << "; that is right only for parts of one building that can hit each other";
      keep();
    }
    if (report_.left_behind > 0) {
      warn() << report_.left_behind << " nodes face nothing but have the other face up to "
             << report_.farthest_behind << " m behind them; there is no contact for them";
      keep();
    }
    if (report_.inner_facets > 0) {
      warn() << report_.inner_facets
             << " facets have elements on both of their sides, inside their structure; name the "
                "outer faces only";
      keep();
    }
  }

 private:
  std::ostringstream& warn() {
    text_.str("");
    text_.precision(4);
    text_ << "contact " << contact_.name << ": ";
    return text_;
  }
  void keep() { warnings_.push_back(text_.str()); }

  void check_overlap() {
    const double overlap = -report_.smallest_gap;
    const bool given = !contact_.gap.is_of_meshes();
    if (overlap > deepest_overlap * model_size_) {
      const double half = report_.half_thickness[0] + report_.half_thickness[1];
      std::ostringstream text;
      text.precision(4);
      if (given) {
        text << "option -" << contact_.name << (contact_.gap.survey.empty() ? "_gap" : "_survey")
             << ": a gap of " << report_.smallest_gap << " m";
      } else {
        text << "contact " << contact_.name << ": the meshes overlap by " << overlap << " m";
        if (half > 0) text << ", their shells reaching " << half << " m beyond their nodes";
      }
      text << ", more than " << deepest_overlap << " of the model's " << model_size_
           << " m, cannot be meant: bodies stay as deep in each other as they begin; "
           << (given ? "give the gap that is open" : "move a mesh, or give the gap as a number");
      throw UserError(text.str());
    }
    if (overlap > round_off * model_size_) {
      warn() << "the bodies overlap by up to " << 1000 * overlap << " mm at the start, at "
             << report_.overlapping << " of " << report_.pairs
             << " pairs; contact stops closing faces and pushes nothing out";
      keep();
    }
  }

  void check_given_gap() {
    const bool wall = contact_.primary.is_wall();
    const double more = report_.largest_gap - report_.geometric_gap[1];
    if (wall && report_.largest_gap > model_size_) {
      warn() << "the gap given, " << report_.largest_gap << " m, is longer than the whole model ("
             << model_size_ << " m); gaps are in metres";
      keep();
    } else if (!wall && more > other_unit * model_size_) {
      warn() << "the gap given, up to " << report_.largest_gap << " m, exceeds that of the meshes, "
             << report_.geometric_gap[1] << " m, in a model of " << model_size_
             << " m; gaps are in metres";
      keep();
    } else if (!wall && -report_.geometric_gap[0] > deepest_overlap * model_size_) {
      warn() << "the meshes overlap by up to " << -1000 * report_.geometric_gap[0]
             << " mm, the gap given is at least " << 1000 * report_.smallest_gap << " mm";
      keep();
    }
  }

  const Contact& contact_;
  const InterfaceReport& report_;
  double model_size_;
  std::vector<std::string>& warnings_;
  std::ostringstream text_;
};

bool same(const ContactSide& a, const ContactSide& b) {
  return a.structure == b.structure && a.group == b.group;
}

bool join_the_same(const Contact& a, const Contact& b) {
  if (a.stop || b.stop) return false;  // along other directions, perhaps
  return (same(a.secondary, b.secondary) && same(a.primary, b.primary)) ||
         (same(a.secondary, b.primary) && same(a.primary, b.secondary));
}

}  // namespace

std::vector<std::string> check_gaps(const Contact& contact, const InterfaceReport& report,
                                    double model_size) {
  std::vector<std::string> warnings;
  ContactCheck(contact, report, model_size, warnings).check_gaps();
  return warnings;
}

void check_contacts(const Scene& scene, Interface& interface) {
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    ContactCheck(scene.contacts[c], interface.reports[c], interface.model_size, interface.warnings)
        .check();
    for (std::size_t before = 0; before < c; ++before) {
      if (join_the_same(scene.contacts[before], scene.contacts[c])) {
        interface.warnings.push_back("contacts " + scene.contacts[before].name + " and " +
                                     scene.contacts[c].name +
                                     " join the same faces: together they have one impulse, how it "
                                     "is shared between them means nothing");
      }
    }
  }
}

}  // namespace pounding::interactions
