#include "scene/standard_sections.h"

#include <array>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "scene/option_values.h"
#include "scene/standard_parts.h"

namespace pounding {
namespace standard_sections_test {

/// What tables list: area, inertias about y and z, torsion, in units of `length`.
struct Listed {
  const char* name;
  double area, inertia_y, inertia_z, torsion;
};

void expect_numbers(const Listed& listed, double length, double inertia_part, double torsion_part) {
  const auto found = standard_section(listed.name);
  ASSERT_TRUE(found) << listed.name;
  const double square = length * length;
  const double fourth = square * square;
  EXPECT_NEAR(found->area / (listed.area * square), 1, 0.006) << listed.name;
  EXPECT_NEAR(found->inertia_y / (listed.inertia_y * fourth), 1, inertia_part) << listed.name;
  EXPECT_NEAR(found->inertia_z / (listed.inertia_z * fourth), 1, inertia_part) << listed.name;
  EXPECT_NEAR(found->torsion / (listed.torsion * fourth), 1, torsion_part) << listed.name;
}

TEST(StandardSections, WideFlangesOfEn10365) {
  for (const Listed& listed :
       {Listed{"IPE200", 28.48, 1943, 142.4, 6.98}, Listed{"IPE300", 53.81, 8356, 603.8, 20.12},
        Listed{"IPE600", 156.0, 92080, 3387, 165.4}, Listed{"HEA200", 53.83, 3692, 1336, 20.98},
        Listed{"HEB120", 34.01, 864.4, 317.5, 13.84}, Listed{"HEB160", 54.25, 2492, 889.2, 31.24},
        Listed{"HEB300", 149.1, 25170, 8563, 185.0}, Listed{"HEM200", 131.3, 10640, 3651, 259.4}}) {
    expect_numbers(listed, 0.01, 0.001, 0.001);
  }
}

TEST(StandardSections, Channels) {
  for (const Listed& listed :
       {Listed{"UPN80", 11.0, 106, 19.4, 2.16}, Listed{"UPN140", 20.4, 605, 62.7, 5.68},
        Listed{"UPN200", 32.2, 1910, 148, 11.9}, Listed{"UPN300", 58.8, 8030, 495, 37.4},
        Listed{"UPN320", 75.8, 10870, 597, 66.7}, Listed{"UPN400", 91.5, 20350, 846, 81.6}}) {
    expect_numbers(listed, 0.01, 0.01, 0.02);
  }
}

TEST(StandardSections, AmericanShapes) {
  for (const Listed& listed :
       {Listed{"W8x31", 9.13, 110, 37.1, 0.536}, Listed{"W10x49", 14.4, 272, 93.4, 1.39},
        Listed{"W12x26", 7.65, 204, 17.3, 0.300}, Listed{"W14x90", 26.5, 999, 362, 4.06},
        Listed{"W14x132", 38.8, 1530, 548, 12.3}, Listed{"W16x100", 29.4, 1490, 186, 7.73},
        Listed{"W24x76", 22.4, 2100, 82.5, 2.68}, Listed{"W18x35", 10.3, 510, 15.3, 0.506}}) {
    expect_numbers(listed, 0.0254, 0.01, 0.02);
  }
  expect_numbers({"W21x44", 13.0, 843, 20.7, 0.770}, 0.0254, 0.01, 0.04);
}

TEST(StandardSections, TubesOfAnySize) {
  for (const Listed& listed :
       {Listed{"HSS8x8x1/2", 13.5, 125, 125, 204}, Listed{"HSS16X8X1/2", 20.9, 679, 230, 563},
        Listed{"HSS14x14x7/8", 41.2, 1170, 1170, 1910},
        Listed{"HSS12x3-1/2x3/8", 10.0, 156, 21.3, 64.7}}) {
    expect_numbers(listed, 0.0254, 0.01, 0.01);
  }
  for (const Listed& listed :
       {Listed{"SHS100x5", 18.7, 279, 279, 439}, Listed{"RHS200x100x8", 44.8, 2234, 739, 1804},
        Listed{"CHS168.3x6", 30.6, 1009, 1009, 2017}}) {
    expect_numbers(listed, 0.01, 0.01, 0.01);
  }
}

/// A foot of a W weighs what its name says: 490 lb/ft3 of steel.
TEST(StandardSections, WeighWhatTheirNamesSay) {
  int count = 0;
  for (const std::string& name : standard_section_names()) {
    if (name[0] != 'W') continue;
    ++count;
    const double weight = *parse_real(name.substr(name.find('X') + 1));
    const double area = standard_section(name)->area / (0.0254 * 0.0254);
    EXPECT_NEAR(area * 490.0 / 144 / weight, 1, 0.015) << name;
  }
  EXPECT_GT(count, 100);
}

TEST(StandardSections, GrowWithinAFamily) {
  const std::vector<std::string> names = standard_section_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (std::size_t i = 1; i < names.size(); ++i) {
    if (names[i][0] == 'W' || names[i].substr(0, 3) != names[i - 1].substr(0, 3)) continue;
    const auto before = *standard_section(names[i - 1]);
    const auto now = *standard_section(names[i]);
    EXPECT_GT(now.area, before.area) << names[i];
    EXPECT_GT(now.inertia_y, before.inertia_y) << names[i];
  }
}

/// kappa of an I with thin walls after G. R. Cowper, J. Appl. Mech. 33 (1966), times the area.
double cowper(double height, double width, double web, double flange) {
  const double nu = 0.3;
  const double m = 2 * width * flange / (height * web);
  const double n = width / height;
  const double above = 10 * (1 + nu) * std::pow(1 + 3 * m, 2);
  const double below = 12 + 72 * m + 150 * m * m + 90 * m * m * m +
                       nu * (11 + 66 * m + 135 * m * m + 90 * m * m * m) +
                       30 * n * n * (m + m * m) + 5 * nu * n * n * (8 * m + 9 * m * m);
  return above / below * (2 * width * flange + height * web);
}

TEST(StandardSections, ShearAreas) {
  const auto mm2 = [](const char* name) {
    const auto found = standard_section(name);
    return std::array{found->shear_area_y * 1e6, found->shear_area_z * 1e6};
  };
  // Cowper, by the middle lines of the walls; flanges 5/6 of theirs; about d t_w.
  EXPECT_NEAR(mm2("HEB160")[1] / cowper(147, 160, 8, 13), 1, 0.01);
  EXPECT_NEAR(mm2("IPE300")[1] / cowper(289.3, 150, 7.1, 10.7), 1, 0.02);
  EXPECT_NEAR(mm2("W24x76")[1] / cowper(589.8, 228.3, 11.18, 17.27), 1, 0.02);
  EXPECT_NEAR(mm2("W24x76")[1] / (607.1 * 11.18), 1, 0.07);
  EXPECT_NEAR(mm2("HEB160")[0], 5.0 / 6 * 2 * 160 * 13, 1e-6);
  // A thin square tube: 5/12 of its area; a tube twice as high as wide has more along its height.
  EXPECT_NEAR(mm2("SHS1000x1")[0] / (4 * 999), 5.0 / 12, 1e-3);
  EXPECT_EQ(mm2("SHS1000x1")[0], mm2("SHS1000x1")[1]);
  EXPECT_GT(mm2("RHS200x100x8")[1], 1.8 * mm2("RHS200x100x8")[0]);
  // A thin round tube 1/2 of its area, a rectangle 5/6, a circle 9/10.
  EXPECT_NEAR(mm2("CHS1000x1")[0] / (3.14159265 * 999), 0.5, 1e-3);
  EXPECT_NEAR(mm2("RECT400x200")[0], 400 * 200 * 5.0 / 6, 1e-6);
  EXPECT_NEAR(mm2("ROUND100")[1], 0.9 * 3.14159265 * 2500, 1e-3);
  // A channel bears along its web about its web; across, its web spoils what its flanges bear.
  EXPECT_NEAR(mm2("UPN200")[1] / (8.5 * 200), 0.9, 0.1);
  EXPECT_NEAR(mm2("UPN200")[0] / (5.0 / 6 * 2 * 75 * 11.5), 0.56, 0.03);
  for (const std::string& name : standard_section_names()) {
    const auto found = *standard_section(name);
    EXPECT_GT(found.shear_area_y, 0.14 * found.area) << name;
    EXPECT_GT(found.shear_area_z, 0.15 * found.area) << name;
    EXPECT_LT(found.shear_area_y + found.shear_area_z, found.area) << name;
  }
}

TEST(StandardSections, SolidOnesOfAnySize) {
  const auto rectangle = *standard_section("RECT400x200");
  EXPECT_NEAR(rectangle.area, 0.08, 1e-12);
  EXPECT_NEAR(rectangle.inertia_y, 0.2 * 0.064 / 12, 1e-12);
  EXPECT_NEAR(rectangle.inertia_z, 0.4 * 0.008 / 12, 1e-12);
  EXPECT_NEAR(rectangle.torsion / (0.22868 * 0.4 * 0.008), 1, 1e-4);  // Timoshenko, a / b = 2
  EXPECT_EQ(standard_section("rect200x400")->torsion, rectangle.torsion);
  EXPECT_NEAR(standard_section("RECT1x1")->torsion / 1e-12, 0.140577, 1e-6);
  const auto circle = *standard_section("ROUND100");
  EXPECT_NEAR(circle.area, 7.853982e-3, 1e-9);
  EXPECT_NEAR(circle.inertia_y, 4.908739e-6, 1e-11);
  EXPECT_NEAR(circle.torsion, 9.817477e-6, 1e-11);
}

TEST(StandardSections, NamesInAnyCaseAndOrder) {
  EXPECT_EQ(standard_section("heb160")->area, standard_section("HEB160")->area);
  EXPECT_EQ(standard_section("HE160B")->area, standard_section("HEB160")->area);
  EXPECT_EQ(standard_section("w14x132")->area, standard_section("W14X132")->area);
  for (const char* name : {"", "HEB", "HEB165", "HE160C", "W14", "SHS", "SHS100", "SHS100x60",
                           "SHS100x-5", "SHS100x5x5", "HSS8x8x1/0", "HSS8x8x/2", "CHSx", "RECT100",
                           "RECT0x5", "ROUND", "ROUND5x5", "concrete"}) {
    EXPECT_FALSE(standard_section(name)) << name;
  }
}

TEST(StandardMaterials, AreThoseOfTheirStandards) {
  EXPECT_EQ(standard_material("S355")->young, 210e9);
  EXPECT_EQ(standard_material("a992")->young, 200e9);
  // Secant moduli of table 3.1 of EN 1992-1-1 [GPa], rounded there.
  const std::pair<const char*, double> listed[] = {{"C20/25", 30}, {"C25", 31}, {"C30/37", 33},
                                                   {"C40/50", 35}, {"c50", 37}, {"C90/105", 44}};
  for (const auto& [name, young] : listed) {
    EXPECT_NEAR(standard_material(name)->young, young * 1e9, 0.51e9) << name;
  }
  for (const char* name : {"", "S", "C", "C33", "concrete", "steel"}) {
    EXPECT_FALSE(standard_material(name)) << name;
  }
  for (const std::string& name : standard_material_names()) EXPECT_TRUE(standard_material(name));
}

}  // namespace standard_sections_test
}  // namespace pounding
