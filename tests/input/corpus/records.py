"""Recorded motions: files that are none, and numbers that contradict one another."""
from corpus.case import Case, SCENE
from corpus.meshes import edited

ROWS = "".join(f"{0.01 * i:.2f} {value}\n" for i, value in enumerate((0, .1, .2, .1, -.1, -.2, -.1, .1, 0, 0)))
VALUES = "".join(f"{value}\n" for value in (0, .1, .2, .1, -.1, -.2, -.1, .1, 0, 0))
AT2 = ("PEER STRONG MOTION DATABASE RECORD\nA STATION, 90\nACCELERATION TIME HISTORY IN UNITS OF G\n"
       "NPTS=   10, DT=   .01000 SEC\n  .000E+00  .100E+00  .200E+00  .100E+00 -.100E+00\n"
       " -.200E+00 -.100E+00  .100E+00  .000E+00  .000E+00\n")


def record(name, content, words, *arguments, file="record.csv", unit="g"):
    """A record in the place of the sound one, its unit given."""
    unit_words = ["-motion_x_unit", unit] if unit else []
    path = ["-motion_x_record", "{folder}/" + file]
    return Case(name, [*path, *unit_words, *arguments], ["{folder}/" + file, *words], {file: content})


FILES = [
    Case("no such record", ["-motion_x_record", "{folder}/none.AT2"], ["{folder}/none.AT2", "opened"]),
    Case("a folder as a record", ["-motion_x_record", "{folder}"], ["{folder}", "is a folder"]),
    record("an empty record", "", ["is empty"]),
    record("blank lines", "\n\n \n", ["is empty"]),
    record("bytes as a record", bytes(range(256)), ["not a text file"]),
    record("prose as a record", "Dear sir,\nhere is the record.\n", []),
    record("a header alone", "time, acceleration\n", ["no line of numbers"]),
    Case("a device without an end as a record", ["-motion_x_record", "/dev/zero"], ["/dev/zero", "device"]),
    Case("a device without an end as a target", ["-motion_x_record", "none", "-motion_y_target", "/dev/zero",
                                                 "-motion_y_pga", "1"], ["/dev/zero", "device"]),
    record("counts of a recorder", "units: counts\n" + ROWS, ["counts", "docs/reference/records.md"]),
    record("a title below numbers", "A TITLE\n1 2 3\n4 5 6\nthe values in g follow\n" + ROWS,
           ["line of words", "header"]),
    record("commas of which nothing tells", "3,1\n2,5\n4,2\n", ["decimal comma"], "-motion_x_time_step", "0.01"),
    record("one value", "0.1\n", ["at least 2"], "-motion_x_time_step", "0.01"),
    record("a record of a spectrum", "period [s], PSA [g]\n0.1 0.2\n0.2 0.4\n0.3 0.3\n", ["spectrum"]),
    record("a record of velocities", "velocity in cm/s\n" + ROWS, ["velocity", "accelerogram"]),
    record("a record of displacements", "displacement in cm\n" + ROWS, ["displacement", "accelerogram"]),
    record("JSON that is cut", '{"dT": 0.01, "accel_data": [0.1, 0.2', ["JSON"], file="record.json"),
    record("JSON without a step", '{"accel_data": [0.1, 0.2, 0.1]}', ["time step"], file="record.json"),
    record("JSON with a word among the numbers", '{"dT": 0.01, "accel_data": [0.1, "x", 0.1]}', ["JSON"],
           file="record.json"),
    record("JSON with a nested list", '{"dT": 0.01, "accel_data": [[0.1, 0.2], [0.1]]}', ["JSON"],
           file="record.json"),
]

NUMBERS = [
    record("a nan among the values", ROWS.replace("-0.2", "nan"), ["nan", "not a finite number"]),
    record("an inf among the values", ROWS.replace("-0.2", "inf"), ["inf", "not a finite number"]),
    record("1e999 among the values", ROWS.replace("-0.2", "1e999"), ["1e999", "not a finite number"]),
    record("a word among the values", ROWS.replace("-0.2", "missing"), ["missing", "not a finite number"]),
    record("a value of 7e3e2", VALUES.replace("-0.2", "7e3e2"), ["7e3e2"], "-motion_x_time_step", "0.01"),
    record("an empty line among the values", ROWS.replace("0.05 -0.2\n", "\n"), ["empty line"]),
    record("a row with one number less", ROWS.replace("0.05 -0.2", "0.05"), ["numbers where"]),
    record("a row with one number more", ROWS.replace("0.05 -0.2", "0.05 -0.2 7"), ["numbers where"]),
    record("a spoilt first row", ROWS.replace("0.00 0\n", "0.00\n"), ["numbers where"]),
    record("values of 1e12 g", ROWS.replace("0.2", "1e12"), ["peak", "correct the unit"]),
    record("values of 300 g", ROWS.replace("0.2", "300"), ["300 g", "correct the unit"]),
]

TIMES = [
    record("no step at all", VALUES, ["time step", "time_step"]),
    record("a step of the option against that of the times", ROWS, ["0.01", "0.02", "contradict"],
           "-motion_x_time_step", "0.02"),
    record("a step of the option against the header", AT2, ["0.01", "0.005", "contradict"],
           "-motion_x_time_step", "0.005", file="record.AT2", unit=""),
    record("times that fall", ROWS.replace("0.06", "0.04"), ["must increase"]),
    record("times that stand still", ROWS.replace("0.06", "0.05"), ["must increase"]),
    record("a gap in the times", ROWS.replace("0.06 -0.1\n", "") + "0.10 0\n", ["uniform step"]),
    record("times of two steps", ROWS + "0.11 0\n0.13 0\n0.15 0\n0.17 0\n", ["uniform step"]),
    record("fewer values than announced", AT2.replace("NPTS=   10", "NPTS= 4000"), ["4000", "announces"],
           file="record.AT2", unit=""),
    record("a step of zero in the header", AT2.replace(".01000", ".00000"), ["not positive"],
           file="record.AT2", unit=""),
    record("a negative step in the header", AT2.replace("   .01000", "  -.01000"), ["{folder}"],
           file="record.AT2", unit=""),
    record("two steps in the header", AT2.replace("A STATION", "A STATION NPTS=   10, DT=   .00500 SEC"),
           ["header says"], file="record.AT2", unit=""),
    record("a word among the values of an AT2", AT2.replace("-.200E+00", "-.2OOE+00"), ["-.2OOE+00"],
           file="record.AT2", unit=""),
]

UNITS = [
    record("no unit", ROWS, ["unit", "g, m/s2, cm/s2 or mm/s2"], unit=""),
    record("two units in the header", "acceleration in g or m/s2\n" + ROWS, ["several units"], unit=""),
    record("a unit against the header", AT2, ["m/s2", "header says"], file="record.AT2", unit="m/s2"),
    Case("a unit that is none", ["-motion_x_unit", "mg"], ["-motion_x_unit mg", "cm/s2"]),
]

COLUMNS = [
    record("a column beyond the last", ROWS, ["column 7"], "-motion_x_column", "7"),
    record("the column of the times", ROWS, ["column 1 is the time"], "-motion_x_column", "1"),
]

SCALES = [
    record("a silent record with a pga", ROWS.replace("0.1\n", "0\n").replace("0.2\n", "0\n").replace("-", ""),
           ["zero throughout"], "-motion_x_pga", "1"),
]

TARGET = "# Hz, PSA / PGA\n0.2 0.5\n1 1.5\n3 2.5\n10 2.2\n33 1\n"


def target(name, content, words, *arguments, pga="pga: 1, "):
    """A synthetic motion in the place of the record."""
    motion = "x: {" + pga + "target: {folder}/target.csv, duration: 2, envelope: \"0.5,1\"}"
    scene = edited(SCENE, ("x: {record: {folder}/record.csv}", motion))
    return Case(name, arguments, words, {"target.csv": content, "scene.yaml": scene})


TARGETS = [
    target("an empty target", "", ["{folder}/target.csv"]),
    target("a target of one line", "1 2\n", ["{folder}/target.csv", "at least 2"]),
    target("a target that is out of order", TARGET + "5 2\n", ["{folder}/target.csv", "out of order"]),
    target("a target with a frequency twice", TARGET + "33 1\n", ["{folder}/target.csv"]),
    target("a target with a ratio of zero", TARGET.replace("2.5", "0"), ["{folder}/target.csv", "positive"]),
    target("a target with a nan", TARGET.replace("2.5", "nan"), ["{folder}/target.csv"]),
    target("a target with a negative frequency", TARGET.replace("0.2 0.5", "-0.2 0.5"), ["{folder}/target.csv"]),
    target("a target of three columns", TARGET.replace("3 2.5", "3 2.5 1"), ["{folder}/target.csv"]),
    target("a target without a pga", TARGET, ["pga"], pga=""),
    target("a target of no duration", TARGET, ["-motion_x_duration 0"], "-motion_x_duration", "0"),
    target("an envelope that ends before it rises", TARGET, ["-motion_x_envelope 1,0.5"], "-motion_x_envelope",
           "1,0.5"),
    target("an envelope beyond the duration", TARGET, ["-motion_x_envelope 1,30"], "-motion_x_envelope", "1,30"),
    target("no such target", TARGET, ["{folder}/none.csv"], "-motion_x_target", "{folder}/none.csv"),
]

CASES = FILES + NUMBERS + TIMES + UNITS + COLUMNS + SCALES + TARGETS
