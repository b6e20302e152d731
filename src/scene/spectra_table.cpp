#include "scene/option_table.h"
#include "scene/row_collector.h"

namespace pounding {
namespace {

struct SpectraCommand {
  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("-channels", names("none"), "history: which channels, as s2_floor2.x, or s2_floor2 for its three directions; none: all");
    option("-frame", word("absolute|relative", "absolute"), "history: the absolute acceleration, or less that of the ground");
    option("-columns", reals("column", absent("left out: the only one beside the time"), "numbers between commas", at_least_1), "record: which columns, counted from 1");
    option("-unit", word("g|m/s2|cm/s2|mm/s2", absent("left out: as its header says")), "record: its unit");
    option("-time-step", real("s", absent("left out: as the file says"), positive), "record: its time step");
    option("-start", real("s", "0", not_negative), "begin there, with oscillators at rest; 0: where the samples begin");
    option("-damping", reals("ratio", "0.05", "numbers between commas", damping_ratio), "damping ratios");
    option("-frequencies", text("list", "0.5:400:200log", "regulatory, START:STOP:COUNTlog, START:STOP:COUNTlin or f1,f2,..., increasing, above 0 [Hz]"), "frequencies [Hz]: START:STOP:COUNTlog, ...lin, f1,f2,..., or regulatory: the 75 from 0.2 to 34 Hz of U.S. NRC Regulatory Guide 1.122");
    option("-true", flag(false), "also the true peaks: relative velocity, absolute and relative acceleration");
    option("-after", word("auto|free_vibration|ignored", "auto"), "whether the free vibration after the last sample counts; auto: it does for a record, not for a history, which is cut short");
    option("-envelope", flag(false), "the envelope of all channels instead of each");
    option("-rotd", reals("percent", absent("left out: each component"), "numbers between commas", percentage), "percentiles over all horizontal directions of a pair of components: 50 (RotD50), 100 (RotD100); of a history x and y of every probe, of records two columns or files");
    option("-broaden", real("percent", "0", half_open(0, 100)), "widen every peak by so much to both sides (15 in Regulatory Guide 1.122)");
    option("-treatment", text("names", "complete", "complete, all_peaks, highest_peak, without_peaks, dirac or all, between commas"), "part of a signal with impacts that is kept, one or more of:\n  complete       everything\n  all_peaks      the samples during contacts, zero between them\n  highest_peak   of these the one with the largest impulse\n  without_peaks  everything but the peaks\n  dirac          a triangle of this impulse, its base two time steps\n  all            the five of them\n");
    option("-impacts", text("file", absent("left out: the one beside FILE"), "a file"), "when the bodies touch: impacts.csv of the run");
    option("-contacts", names("none"), "whose impacts make the peaks; none: all");
    option("-margin", real("s", "0", not_negative), "time added to a contact on both sides");
    option("-dirac-step", real("s", absent("left out: the time step in summary.json beside FILE"), positive), "half the base of the triangle");
    option("-output", text("file", absent("left out: standard output"), "a file"), "CSV of the spectra");
    option("-peaks", text("file", absent("left out: none"), "a file"), "CSV of the peaks: start, end, impulse of the floor per unit of mass");
    option("-samples", text("file", absent("left out: none"), "a file"), "CSV of the samples as they were read: time, acceleration");
    option("-accept", text("file", absent("left out: spectra"), "a file"), "judge the motion, or the set of them, by a table of rules (docs/manual/motions.md); no spectra then: --output has a row for each rule");
    option("-anchor", text("pga", absent("left out: as the rules say"), "a number and its unit, as 0.3g"), "rules: peak acceleration of their targets, as 0.3g or 3m/s2");
    option("-directions", text("names", absent("left out: x,y,z, as many as FILEs"), "x, y and z between commas"), "rules: components of each motion, in the order of the FILEs");
    option("-digits", integer("digits", "9", digit_count), "significant ones of every number; 17: to the bit");
    // clang-format on
  }
};

}  // namespace

std::span<const OptionRow> spectra_option_table() {
  static const std::vector<OptionRow> rows = [] {
    RowCollector collector{OptionBlock::spectra, {}};
    SpectraCommand::describe(collector);
    return collector.rows;
  }();
  return rows;
}

}  // namespace pounding
