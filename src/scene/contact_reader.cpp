#include "scene/contact_reader.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/facts.h"
#include "scene/option_values.h"
#include "scene/structure_reader.h"

namespace pounding {
namespace {

constexpr const char* patches_option = "<contact>_gap_patches";

/// "place,place,radius,gap; place,place,place,place,gap": a disc or a rectangle each.
std::vector<GapPatch> read_patches(OptionReader& options, const OptionReader::Names& names) {
  std::vector<GapPatch> patches;
  const std::string text = options.path(patches_option, names);
  if (text.empty()) return patches;
  for (const std::string& piece : split(text, ';')) {
    const auto refuse = [&](const std::string& why) {
      options.refuse(patches_option, names, "'" + shown_value(piece) + "' " + why);
    };
    const std::optional<std::vector<double>> found = parse_reals(piece);
    if (!found || (found->size() != 4 && found->size() != 5)) {
      refuse("is neither four numbers nor five");
    }
    const std::vector<double>& number = *found;
    GapPatch patch;
    patch.gap = number.back();
    if (patch.gap < 0) refuse("has a gap below 0; 0 is a joint that is filled there");
    if (number.size() == 4) {
      patch.radius = number[2];
      if (!(patch.radius > 0)) refuse("has no radius above 0");
      patch.low = patch.high = {number[0], number[1]};
    } else {
      patch.low = {number[0], number[1]};
      patch.high = {number[2], number[3]};
      if (!(patch.low[0] < patch.high[0] && patch.low[1] < patch.high[1])) {
        refuse("has its corners not in the order of the places");
      }
    }
    patches.push_back(patch);
  }
  return patches;
}

constexpr std::string_view filler_option = "<contact>_filler";
constexpr std::string_view unloading = "<contact>_filler_unloading";
constexpr std::string_view crushing_option = "<contact>_crushing";

std::vector<Filler::Point> read_filler_table(OptionReader& options,
                                             const OptionReader::Names& names) {
  std::vector<Filler::Point> points;
  Filler::Point before;
  for (const std::string& item : split(options.text(filler_option, names), ',')) {
    const std::vector<std::string> words = split(item, ':');
    const auto strain = words.size() == 2 ? parse_real(words[0]) : std::nullopt;
    const auto pressure = words.size() == 2 ? parse_real(words[1]) : std::nullopt;
    if (!strain || !pressure) {
      options.refuse(filler_option, names, "'" + item + "' is not strain:pressure");
    }
    options.refuse_if(!(*strain > before.strain && *strain <= 1), filler_option, names,
                      "strains must rise from 0, to 1 at most");
    options.refuse_if(!(*pressure >= before.pressure), filler_option, names,
                      "pressures must not fall");
    before = {*strain, *pressure};
    points.push_back(before);
  }
  if (!(before.pressure > 0)) options.refuse(filler_option, names, "it never presses");
  return points;
}

/// A strip of the faces: elastic up to its strength, which it keeps to its end.
std::optional<Filler> read_crushing(OptionReader& options, const OptionReader::Names& names) {
  if (!options.given(crushing_option, names)) {
    options.forbid_all<Crushing>(names, goes_with(crushing_option));
    return std::nullopt;
  }
  Crushing strip;
  options.read(strip, names);
  options.refuse_if(
      !(strip.elastic_depth() < strip.depth), "<contact>_crushing_depth", names,
      sentence("the strip is elastic for {} m, its strength over its stiffness; give more",
               {strip.elastic_depth()}));
  return strip.filler();
}

constexpr std::string_view stop_along = "<contact>_along";
constexpr std::string_view stop_stiffness = "<contact>_stiffness";
constexpr std::string_view stop_dashpot = "<contact>_dashpot";

constexpr std::string_view closing_option = "<contact>_static_closing";

StaticClosing read_static_closing(OptionReader& options, const OptionReader::Names& names) {
  StaticClosing points;
  const std::string text = options.path(closing_option, names);
  for (const std::string& item : text.empty() ? std::vector<std::string>{} : split(text, ',')) {
    const std::vector<std::string> words = split(item, ':');
    const auto elevation = words.size() == 2 ? parse_real(words[0]) : std::nullopt;
    const auto closing = words.size() == 2 ? parse_real(words[1]) : std::nullopt;
    if (!elevation || !closing) {
      options.refuse(closing_option, names, "'" + shown_value(item) + "' is not elevation:closing");
    }
    options.refuse_if(!points.elevations.empty() && !(*elevation > points.elevations.back()),
                      closing_option, names, "elevations must rise");
    points.elevations.push_back(*elevation);
    points.closings.push_back(*closing);
  }
  return points;
}

/// Values of the gap, or its survey, its random part, and patches.
InitialGap read_gap(OptionReader& options, const std::string& contact, bool is_wall) {
  const OptionReader::Names names{contact};
  InitialGap gap;
  options.read(gap, names);
  if (options.text("<contact>_gap", names) != "geometry") {
    options.refuse_if(!gap.survey.empty(), "<contact>_survey", names,
                      "not beside -<contact>_gap: the survey is the gap; leave one of them out");
    gap.values = options.reals("<contact>_gap", names);
    const std::size_t count = gap.values.size();
    options.refuse_if(count != 1 && count != 2 && count != 4, "<contact>_gap", names,
                      "wrong count of numbers");
  } else if (is_wall && gap.survey.empty()) {
    options.refuse("<contact>_gap", names, "a wall has no geometry, give its distance");
  }
  gap.patches = read_patches(options, names);
  gap.static_closing = read_static_closing(options, names);
  return gap;
}

/// The filler of the joint, or the strip of its faces to crush, if it has one.
std::optional<Filler> read_filler(OptionReader& options, const std::string& contact) {
  const OptionReader::Names names{contact};
  if (!options.given(filler_option, names) || options.text(filler_option, names) == "none") {
    options.forbid_all<Filler>(names, goes_with(filler_option), filler_option);
    return read_crushing(options, names);
  }
  options.forbid(crushing_option, names,
                 "not beside -<contact>_filler: a joint has a filler, or faces that are crushed");
  options.forbid_all<Crushing>(names, goes_with(crushing_option));
  Filler filler;
  filler.table = read_filler_table(options, names);
  options.read(filler, names);
  options.refuse_if(filler.unloading < filler.steepest() * (1 - 1e-12), unloading, names,
                    sentence("the table is steeper, {} Pa somewhere", {filler.steepest()}));
  return filler;
}

/// Refuses faces that slide, matrices that would not hold the filler or the strip, and friction
/// beside a strip. `exports`: the run writes matrices.
void check_filler(const OptionReader& options, const Contact& contact, bool exports) {
  const OptionReader::Names names{contact.name};
  const bool crushes = contact.crushes();
  const std::string owner = "contact " + contact.name + " has a ";
  options.refuse_if(
      contact.sliding > 0, "<contact>_sliding", names,
      owner + (crushes ? "strip that is crushed" : "filler") + ", which stays where it is");
  options.refuse_if(exports, "export_matrices", {},
                    owner + (crushes ? "strip" : "filler") + ", which is no matrix; not with -" +
                        option_name(crushes ? crushing_option : filler_option, names));
  options.refuse_if(crushes && contact.friction > 0, "<contact>_friction", names,
                    "not beside -<contact>_crushing: friction acts in hard contact only, which "
                    "begins where the strip is crushed to the last");
}

/// The stop between nodes that a contact is, if `along` is given.
std::optional<Stop> read_stop(OptionReader& options, const std::string& contact) {
  const OptionReader::Names names{contact};
  if (!options.given(stop_along, names)) {
    options.forbid_all<Stop>(
        names, "it makes a stop of a contact that has a direction; give -<contact>_along");
    return std::nullopt;
  }
  Stop stop;
  options.read(stop, names);
  const std::string word = options.text(stop_along, names);
  if (word != "line") {
    const auto along = parse_point(word);
    const double length = along ? std::hypot((*along)[0], (*along)[1], (*along)[2]) : 0;
    if (!(length > 0) || !std::isfinite(length)) options.refuse(stop_along, names);
    stop.along = Vector3{(*along)[0] / length, (*along)[1] / length, (*along)[2] / length};
  }
  options.refuse_if(stop.dashpot > 0 && !(stop.stiffness > 0), stop_dashpot, names,
                    "it " + goes_with(stop_stiffness));
  return stop;
}

/// Refuses options of faces beside a stop, gaps that it cannot have, friction where it gives way,
/// and matrices that would not hold it. `exports`: the run writes matrices.
void check_stop(const OptionReader& options, const Contact& contact, bool exports) {
  const OptionReader::Names names{contact.name};
  const std::string why = "-<contact>_along makes it a stop between nodes, which have no faces";
  options.forbid_each(
      "<contact>_",
      {"passes", "gap_deviation", "gap_patches", "survey", "static_closing", "sliding"}, names,
      why);
  options.forbid_all<Filler>(names, why);
  options.forbid_all<Crushing>(names, why);
  const std::vector<double>& gaps = contact.gap.values;
  options.refuse_if(
      gaps.empty() || gaps.size() > 2, "<contact>_gap", names,
      "a stop takes one number, or two if it stops both ways; give the way until it closes");
  if (std::ranges::any_of(gaps, [](double gap) { return gap < 0; })) {
    options.refuse("<contact>_gap", names, "a stop is open or just closed; give 0 or more");
  }
  options.refuse_if(!contact.stop->along && contact.primary.is_wall(), stop_along, names,
                    "there is no line to a wall; give a direction x,y,z");
  options.refuse_if(contact.friction > 0 && contact.is_elastic(), "<contact>_friction", names,
                    "not beside -<contact>_stiffness: only a hard stop has friction");
  options.refuse_if(contact.is_elastic() && exports, "export_matrices", {},
                    "stop " + contact.name + " gives way, which is no matrix; not with -" +
                        contact.name + "_stiffness");
}

ContactSide read_side(OptionReader& options, Scene& scene, std::string_view pattern,
                      const std::string& contact) {
  const std::vector<std::string> words = split(options.text(pattern, {contact}), ':');
  options.refuse_if(words.size() != 2 || words[0].empty() || words[1].empty(), pattern, {contact});
  named_structure(options, scene, pattern, {contact}, words[0]);
  group_points(scene, option_name(pattern, {contact}), words[0], words[1]);
  return {words[0], words[1]};
}

/// Whether the gap is that of the rest that the run starts from.
void read_gap_state(OptionReader& options, const Scene& scene, Contact& contact) {
  const std::string state = options.choice("<contact>_gap_at", {contact.name});
  const std::vector<double>& values = contact.gap.values;
  const auto negative = [](double gap) { return gap < 0; };
  const auto above_zero = [](double gap) { return gap > 0; };
  options.refuse_if(state == "rest" && std::ranges::any_of(values, negative), "<contact>_gap_at",
                    {contact.name},
                    "at rest the joint is open or just closed; give a gap of 0 or more");
  const bool laid_in = contact.filler || contact.is_elastic();
  options.refuse_if(state == "unloaded" && laid_in && scene.preload, "<contact>_gap_at",
                    {contact.name},
                    std::string(contact.crushes() ? "a strip that is crushed"
                                : contact.filler  ? "the filler"
                                                  : "a stop that gives way") +
                        " is laid into the joint as it is at rest; leave it out");
  const auto is_open = [](const GapPatch& patch) { return patch.gap > 0; };
  const bool faces = !contact.primary.is_wall();
  const bool open = faces && !values.empty() && std::ranges::all_of(values, above_zero) &&
                    std::ranges::all_of(contact.gap.patches, is_open);
  const bool open_in_part = faces && !open &&
                            (std::ranges::any_of(values, above_zero) ||
                             std::ranges::any_of(contact.gap.patches, is_open));
  options.refuse_if(state == "auto" && scene.preload && open_in_part && !laid_in, "<contact>_gap",
                    {contact.name},
                    "open in one part and not in another, under -preload static; say with "
                    "-<contact>_gap_at rest or unloaded in which state the joint has these gaps");
  // A survey is of the joint at rest.
  const bool assumed =
      state == "auto" && (open || laid_in || (faces && !contact.gap.survey.empty()));
  contact.gap_at_rest = scene.preload && (state == "rest" || assumed);
  contact.gap_assumed_so = contact.gap_at_rest && assumed;
}

}  // namespace

Contact read_contact(OptionReader& options, Scene& scene, const std::string& name) {
  Contact contact;
  contact.name = name;
  contact.secondary = read_side(options, scene, "<contact>_secondary", name);
  contact.primary = options.text("<contact>_primary", {name}) == "wall"
                        ? ContactSide{"wall", ""}
                        : read_side(options, scene, "<contact>_primary", name);
  options.read(contact, {name});
  options.refuse_if(contact.primary.is_wall() && contact.passes == 2, "<contact>_passes", {name},
                    "a wall has no nodes");
  contact.gap = read_gap(options, name, contact.primary.is_wall());
  contact.stop = read_stop(options, name);
  if (contact.stop) {
    check_stop(options, contact, !scene.export_matrices.empty());
  } else {
    contact.filler = read_filler(options, name);
  }
  read_gap_state(options, scene, contact);
  options.refuse_if(contact.sliding > 0 && contact.primary.is_wall(), "<contact>_sliding", {name},
                    "a wall is endless; leave it out");
  if (contact.filler) check_filler(options, contact, !scene.export_matrices.empty());
  options.refuse_if(contact.sliding > 0 && !scene.export_matrices.empty(), "export_matrices", {},
                    "the rows of contact " + name + " change; not with -" + name + "_sliding");
  return contact;
}

}  // namespace pounding
