#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding {

/// Numbers of a cross-section that a beam needs. y is the axis across the web, z the one along it.
struct SectionNumbers {
  double area = 0;       ///< [m2]
  double inertia_y = 0;  ///< about y: bending in the plane of the web [m4]
  double inertia_z = 0;  ///< about z: bending across the web [m4]
  double torsion = 0;    ///< St-Venant torsion constant [m4]
  /// Areas that bear shear along y and z [m2]: I^2 / (integral of (S / t)^2 dA), with S the first
  /// moment beyond a cut of the wall and t its thickness, which gives the energy of the stresses
  /// that balance bending (D. J. Jourawski, 1856); of walls by their middle lines.
  double shear_area_y = 0;
  double shear_area_z = 0;
};

/// Dimensions of a rolled section [m].
struct RolledShape {
  double height = 0;
  double width = 0;
  double web = 0;          ///< thickness of the web
  double flange = 0;       ///< thickness of a flange
  double root_radius = 0;  ///< between web and flange
  double toe_radius = 0;   ///< at the ends of the flanges of a channel
};

/// An I or H with parallel flanges and two axes of symmetry: areas of rectangles and fillets;
/// torsion as EN 10365 and its catalogues have it,
///     It = 2/3 (b - .63 tf) tf^3 + (h - 2 tf) tw^3 / 3 + 2 (tw/tf) (.145 + .1 r/tf) D^4,
///     D = ((r + tw/2)^2 + (r + tf)^2 - r^2) / (2 r + tf).
SectionNumbers i_section(const RolledShape& shape);

/// A channel with tapered flanges (UPN): the flange's thickness is that at the middle of the
/// width, with a slope of 8 %, or where the height is above 300 mm at the middle of the overhang,
/// with 5 %. Inertias are about its centroid. Torsion after El Darwish and Johnston (1965), for
/// parallel flanges:
///     It = 2/3 b tf^3 + (h - 2 tf) tw^3 / 3 + 2 a D^4 - .42 tf^4,
///     D = 2 (3 r + tw + tf - sqrt(2 (2 r + tw) (2 r + tf))),
///     a = -.0908 + .2621 tw/tf + .1231 r/tf - .0752 tw r / tf^2 - .0945 (tw/tf)^2.
SectionNumbers channel_section(const RolledShape& shape);

/// A rectangular tube with rounded corners, the height along z [m]: EN 10210-2, annex A, with the
/// radii of its corners outside and inside.
SectionNumbers hollow_section(double height, double width, double wall, double outer_radius,
                              double inner_radius);

/// A round tube [m]; shear areas after G. R. Cowper, J. Appl. Mech. 33 (1966), with nu = 0: half of
/// the area of a thin one.
SectionNumbers round_section(double diameter, double wall);

/// A rectangle, the height along z [m]: shear areas 5/6 of it.
SectionNumbers rectangular_section(double height, double width);

/// A solid circle [m]: shear areas 9/10 of it.
SectionNumbers circular_section(double diameter);

/// Numbers of a standard section by its name, in any case: IPE, HEA, HEB, HEM, UPN (HEB160, also
/// HE160B), W (W14x132), and tubes of any size that is one: SHS100x5, RHS200x100x8, CHS168.3x6 in
/// mm, HSS8x8x1/2, HSS8x4x3/8 in inches; solid ones of any size: RECT600x400, ROUND50 in mm.
/// Nothing if there is none of that name.
std::optional<SectionNumbers> standard_section(std::string_view name);

/// Names of the sections that have rows of their own: all but tubes and solid ones.
std::vector<std::string> standard_section_names();

}  // namespace pounding
