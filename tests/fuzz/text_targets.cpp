#include <cstdio>
#include <fstream>

#include "ensemble/member_scene.h"
#include "fuzz/target.h"
#include "motion/ground_motion.h"
#include "motion/records/record_text.h"
#include "motion/synthetic.h"
#include "observers/impact_catalogue.h"
#include "scene/member_table.h"
#include "scene/options_database.h"
#include "scene/scene_reader.h"
#include "unit/motion/record_writers.h"

namespace pounding::fuzz {
namespace {

const std::string rows =
    "0.00 0\n0.01 0.1\n0.02 0.2\n0.03 0.1\n0.04 -0.1\n0.05 -0.2\n0.06 -0.1\n0.07 0.1\n0.08 0\n";

const std::vector<std::string> records{
    "time [s], acceleration [g]\n" + rows,
    "% two columns, m/s2\n" + rows,
    "PEER NGA STRONG MOTION DATABASE RECORD\nIMPERIAL VALLEY 5/19/40, EL CENTRO, 180\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=   10, DT=   .01000 SEC\n"
    "  .000E+00  .100E+00  .200E+00  .100E+00 -.100E+00\n"
    " -.200E+00 -.100E+00  .100E+00  .000E+00  .000E+00\n",
    "ACCELERATION TIME HISTORY IN UNITS OF G\n10 0.0050 NPTS, DT\n 0.1 0.2 0.1 0.0 -0.1\n-0.2 -.1 "
    "0 .1 0\n",
    "    0.01000 DT   8 POINTS CM/SEC**2\n    .001   -.002    .013   -.114    .150   -.200    .010 "
    "   .000\n",
    "{\"numPoints\": 4, \"dT\": 0.01, \"accel_data\": [0.1, 0.2, -0.1, 0.0]}\n",
    "index;time;displacement;acceleration "
    "m/s2\n0;0.00;0;0.1\n1;0.01;0;0.2\n2;0.02;0;-0.1\n3;0.03;0;0\n",
    "0.1\n0.2\n-0.1\n0.05\n0\n",
    "1.5D-02 2.5D-02\n-1.0D-02 0.0D+00\n",
    "t;a [mm/s2]\n0,00;0,01\n0,02;-0,05\n0,04;0,12\n",
    "UNITS ARE SECONDS AND G/10\n 0.00 .1 .02 -.2\n 0.04 .3 .06 -.5\n",
    record_writers::knet(record_writers::wave_of_mean_zero(), 20000),
    record_writers::keyed(record_writers::wave()),
    record_writers::geonet(record_writers::wave(), "N10E", true) +
        record_writers::geonet(record_writers::wave(), "Up", false),
    record_writers::csmip(record_writers::wave(), 1, "90 Deg", true) +
        record_writers::csmip(record_writers::wave(), 2, "Up", true),
    record_writers::cosmos(record_writers::wave(), "cm/s^2"),
    record_writers::bhrc(record_writers::scaled(record_writers::wave(), 1e-3), "L", true),
    record_writers::smc(record_writers::wave(), "2 CORRECTED ACCELEROGRAM", 50)};

const std::string scene =
    "# a scene\nstructures: left,right\nleft:\n  mesh: left.msh\n  clamp: \"base,mid:x+rz\"\n"
    "  damping: {ratio: 0.05, frequencies: \"1,10\"}\n"
    "  body: {element: hex8, material: concrete}\n"
    "  tie: {element: bar, material: steel, area: 1e-4, tension_only: true}\n"
    "  wall: {element: shell, material: steel, thickness: 0.02, damping: {alpha: 0.1, beta: "
    "1e-5}}\n"
    "  machine: {element: point_mass, mass: 50, rotary_inertia: \"1,2,3\"}\n"
    "right:\n  mesh: right.geo\n  mesh_set: h=0.1,slab=hex\n  model: modal\n  modal: {vectors: "
    "20}\n"
    "  pole: {element: beam, material: steel, section: tube}\n"
    "  foot: {element: grounded_spring, stiffness: \"1e8,1e8,1e9\", dashpot: \"1e5,1e5,0,0,0,0\"}\n"
    "material:\n  concrete: {young: 30e9, poisson: 0.2, density: 2400}\n"
    "  steel: {young: 210e9, poisson: 0.3, density: 7850}\n"
    "section:\n  tube: {area: 5e-3, inertia_y: 2e-5, inertia_z: 2e-5, torsion: 4e-5, z_axis: "
    "\"1,0,0\"}\n"
    "contacts: joint,stop\njoint: {secondary: \"left:face\", primary: \"right:face\", gap: "
    "\"0.02,0.025\", passes: 2}\n"
    "stop: {secondary: \"left:side\", primary: wall, gap: 0.1}\n"
    "motion:\n  x: {record: a.AT2, pga: 1.5}\n"
    "  z: {target: b.csv, pga: 1, seed: 3, duration: 20, envelope: \"2,15\"}\n"
    "probes: top,all\ntop: {structure: right, at: \"0,0,1; 1,0,1\", average: false}\n"
    "all: {structure: left, group: body}\nspectra: {damping: \"0.02,0.05\", frequencies: "
    "\"0.5:400:200log\"}\n"
    "end_time: 20\ncourant: 0.9\noutput: results/a\n";

const std::vector<std::string> scenes{
    scene,
    "structures: a\na: {mesh: a.msh, body: {element: hex8, material: m}}\n"
    "material: {m: {young: 1, poisson: 0, density: 1}}\nend_time: 1\n",
    "end_time: 1\nstructures: a\na:\n  mesh: a.msh\n  mass_scaling: 1e-5\n  gravity: 0,0,-9.81\n"
    "  s: {element: spring, stiffness: \"1,1,1,1,1,1\"}\n"};

void read_record(const std::string& path, Random& random) {
  RecordedMotion motion;
  motion.file = path;
  motion.unit = random.one_of<std::string>({"", "g", "m/s2", "cm/s2", "mm/s2"});
  motion.time_step = random.one_of<double>({0, 0, 0.01});
  motion.column = random.one_of<int>({0, 0, 1, 2, 4});
  read_accelerogram(motion);
}

/// A table, and the scene of each of its members.
void read_members(const std::string& path, Random&) {
  static const OptionsDatabase options{{"structures", "left"},
                                       {"left_mesh", "left.msh"},
                                       {"left_model", "modal"},
                                       {"left_modal_vectors", "6"},
                                       {"left_body_element", "hex8"},
                                       {"left_body_material", "m"},
                                       {"material_m_young", "1e9"},
                                       {"material_m_poisson", "0.2"},
                                       {"material_m_density", "2000"},
                                       {"contacts", "joint"},
                                       {"joint_secondary", "left:face"},
                                       {"joint_primary", "wall"},
                                       {"joint_gap", "0.1"},
                                       {"motion_x_target", "a.csv"},
                                       {"motion_x_pga", "1"},
                                       {"probes", "top"},
                                       {"top_structure", "left"},
                                       {"top_group", "face"},
                                       {"end_time", "1"}};
  static const Scene shared = read_scene(options).scene;
  const MemberTable table = read_member_table(MPI_COMM_SELF, path, shared);
  for (std::size_t m = 0; m < table.members(); ++m) read_member(shared, options, table, m);
}

void read_scene_file(const std::string& path, Random&) {
  CommandLine line;
  line.files = {path};
  read_scene(read_options_database(MPI_COMM_SELF, line));
}

}  // namespace

std::vector<Target> text_targets() {
  std::vector<Target> targets;
  targets.push_back({"record",
                     records,
                     {"NPTS=",
                      "DT=",
                      "UNITS OF G",
                      "cm/s2",
                      "m/s2",
                      " g ",
                      "time",
                      "velocity",
                      "acc",
                      "\r\n",
                      "\t",
                      ",",
                      ";",
                      "{",
                      "\"dT\":",
                      "\"accel_data\": [",
                      "%",
                      "1.0D+02",
                      "\xEF\xBB\xBF",
                      "0,05",
                      "-0,1",
                      "Memo.",
                      "Scale Factor 3920(gal)/6182761",
                      "NDATA: 64",
                      "50 sps",
                      "Number of points  64",
                      "64 points of accel data equally spaced at .02 sec, in cm/sec2",
                      "Real-header values follow",
                      "pts, approx 1 secs, units=cm/s^2,Format=",
                      "\n|\n",
                      "Chan  2: Up",
                      "Corrected accelerogram\n",
                      "-32768",
                      "-999",
                      "1e308"},
                     read_record,
                     "record.txt"});
  targets.push_back(
      {"target",
       {"# Hz, ratio\n0.2 0.5\n1 1.5\n3 2.5\n10 2.2\n33 1\n", "f,psa\n33,1\n10,2.2\n0.2,0.5\n"},
       {"#", ",", "Hz", "\n"},
       [](const std::string& path, Random&) { read_target_spectrum(path); },
       "target.csv"});
  targets.push_back(
      {"impacts",
       {"# contact episodes\ncontact,start,end,duration,impulse\nroof,1.0,1.01,0.01,5\n"
        "floor,2.5,2.6,0.1,7\n"},
       {"contact,start,end", ",", "#", "roof"},
       [](const std::string& path, Random&) { read_impact_windows(path); },
       "impacts.csv"});
  targets.push_back(
      {"members",
       {"motion_x_seed,motion_x_pga,joint_gap,left_damping_factor\n1,2.5,\"0.1,0.2\",1\n"
        "2,2.5,,0.5\n",
        "# runs\nmotion_level;joint_gap\n1;0.1\n\n1.4;\"0.1,0.2,0.1,0.2\"\n"},
       {"\"", ",", ";", "#", "\r\n", "motion_level", "left_stiffness_factor", "joint_gap",
        "motion_y_record", "1e300", "-1", "nan"},
       read_members,
       "members.csv"});
  targets.push_back({"scene",
                     scenes,
                     {": ",   "{",           "}",         "[",     "]",
                      "\"",   "'",           "- ",        "#",     "&a ",
                      "*a",   "|",           ">",         "---\n", "...\n",
                      "\t",   "%YAML 1.2\n", "!!binary ", "<<: ",  "? ",
                      "left", "none",        "material",  ",",     "include: x.yaml\n"},
                     read_scene_file,
                     "scene.yaml"});
  return targets;
}

}  // namespace pounding::fuzz
