#include <array>

#include "scene/option_table.h"

namespace pounding {
namespace {

using namespace option_words;

// clang-format off
constexpr std::array spectra_rows{
    OptionRow{Block::spectra, "-channels", Kind::names, "names", value("none"), any, "", "history: which channels, as s2_floor2.x, or s2_floor2 for its three directions; none: all"},
    OptionRow{Block::spectra, "-frame", Kind::choice, "word", value("absolute"), any, "absolute|relative", "history: the absolute acceleration, or less that of the ground"},
    OptionRow{Block::spectra, "-columns", Kind::reals, "column", absent("left out: the only one beside the time"), at_least_1, "numbers between commas", "record: which columns, counted from 1"},
    OptionRow{Block::spectra, "-unit", Kind::choice, "word", absent("left out: as its header says"), any, "g|m/s2|cm/s2|mm/s2", "record: its unit"},
    OptionRow{Block::spectra, "-time-step", Kind::real, "s", absent("left out: as the file says"), positive, "", "record: its time step"},
    OptionRow{Block::spectra, "-start", Kind::real, "s", value("0"), not_negative, "", "begin there, with oscillators at rest; 0: where the samples begin"},
    OptionRow{Block::spectra, "-damping", Kind::reals, "ratio", value("0.05"), damping_ratio, "numbers between commas", "damping ratios"},
    OptionRow{Block::spectra, "-frequencies", Kind::text, "list", value("0.5:400:200log"), any, "regulatory, START:STOP:COUNTlog, START:STOP:COUNTlin or f1,f2,..., increasing, above 0 [Hz]", "frequencies [Hz]: START:STOP:COUNTlog, ...lin, f1,f2,..., or regulatory: the 75 from 0.2 to 34 Hz of U.S. NRC Regulatory Guide 1.122"},
    OptionRow{Block::spectra, "-true", Kind::boolean, "flag", value("false"), any, "", "also the true peaks: relative velocity, absolute and relative acceleration"},
    OptionRow{Block::spectra, "-after", Kind::choice, "word", value("auto"), any, "auto|free_vibration|ignored", "whether the free vibration after the last sample counts; auto: it does for a record, not for a history, which is cut short"},
    OptionRow{Block::spectra, "-envelope", Kind::boolean, "flag", value("false"), any, "", "the envelope of all channels instead of each"},
    OptionRow{Block::spectra, "-rotd", Kind::reals, "percent", absent("left out: each component"), Range{0, 100, false, false}, "numbers between commas", "percentiles over all horizontal directions of a pair of components: 50 (RotD50), 100 (RotD100); of a history x and y of every probe, of records two columns or files"},
    OptionRow{Block::spectra, "-broaden", Kind::real, "percent", value("0"), Range{0, 100, false, true}, "", "widen every peak by so much to both sides (15 in Regulatory Guide 1.122)"},
    OptionRow{Block::spectra, "-treatment", Kind::text, "names", value("complete"), any, "complete, all_peaks, highest_peak, without_peaks, dirac or all, between commas", "part of a signal with impacts that is kept, one or more of:\n  complete       everything\n  all_peaks      the samples during contacts, zero between them\n  highest_peak   of these the one with the largest impulse\n  without_peaks  everything but the peaks\n  dirac          a triangle of this impulse, its base two time steps\n  all            the five of them\n"},
    OptionRow{Block::spectra, "-impacts", Kind::text, "file", absent("left out: the one beside FILE"), any, "a file", "when the bodies touch: impacts.csv of the run"},
    OptionRow{Block::spectra, "-contacts", Kind::names, "names", value("none"), any, "", "whose impacts make the peaks; none: all"},
    OptionRow{Block::spectra, "-margin", Kind::real, "s", value("0"), not_negative, "", "time added to a contact on both sides"},
    OptionRow{Block::spectra, "-dirac-step", Kind::real, "s", absent("left out: the time step in summary.json beside FILE"), positive, "", "half the base of the triangle"},
    OptionRow{Block::spectra, "-output", Kind::text, "file", absent("left out: standard output"), any, "a file", "CSV of the spectra"},
    OptionRow{Block::spectra, "-peaks", Kind::text, "file", absent("left out: none"), any, "a file", "CSV of the peaks: start, end, impulse of the floor per unit of mass"},
    OptionRow{Block::spectra, "-digits", Kind::integer, "digits", value("9"), csv_digits, "", "significant ones of every number; 17: to the bit"},
};
// clang-format on

}  // namespace

std::span<const OptionRow> spectra_option_table() {
  return spectra_rows;
}

}  // namespace pounding
