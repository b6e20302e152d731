from spack.package import *


class Pounding(CMakePackage):
    """Seismic pounding between plant buildings: explicit finite-element dynamics with unilateral contact in parallel,
    floor response spectra to 400 Hz, impacts, energy balance."""

    homepage = "https://pounding.invalid"  # built from sources at hand: spack dev-build
    git = "https://pounding.invalid/pounding.git"

    license("GPL-3.0-or-later")

    version("main", branch="main")
    version("0.2.0", tag="v0.2.0")

    variant("tools", default=True, description="Python for the tools that draw, compare and study (pounding-tools)")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("python", type="build")  # man pages and completion
    depends_on("mpi")
    depends_on("petsc@3.18: +mpi +mumps +double ~complex ~int64")
    depends_on("slepc@3.18:")
    depends_on("hdf5@1.10:")
    depends_on("metis ~int64")
    depends_on("mumps +mpi")
    depends_on("gmsh@4.8: +shared ~fltk")
    depends_on("fftw@3:")
    depends_on("libyaml")
    depends_on("zlib-api")
    depends_on("openssl")
    depends_on("libseccomp")
    depends_on("nlohmann-json@3.11:")
    depends_on("blas")
    depends_on("lapack")

    with when("+tools"):
        depends_on("python@3.11:", type=("build", "run"))
        for module in ("numpy", "scipy", "h5py", "jinja2", "matplotlib", "pyyaml"):
            depends_on(f"py-{module}", type="run")

    requires("%gcc@12:", msg="kernels are written with vectors of g++ 12 or later")

    def cmake_args(self):
        return [self.define("POUNDING_TESTS", False), self.define("POUNDING_VECTOR_UNITS", "all"),
                self.define("PETSC_DIR", self.spec["petsc"].prefix), self.define("SLEPC_DIR", self.spec["slepc"].prefix),
                self.define("PETSC_ARCH", "")]

    def setup_run_environment(self, env):
        env.prepend_path("PYTHONPATH", self.prefix.share.pounding.python)
