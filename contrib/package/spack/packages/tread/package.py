# SPDX-License-Identifier: LGPL-2.1-or-later
"""Recipe for Spack 0.19 to 0.23: doc/packages.md, "Spack"."""

from spack.package import *


class Tread(CMakePackage):
    """Transient rolling of a railway wheel over a rail by explicit finite elements with frictional contact."""

    maintainers = []
    license("LGPL-2.1-or-later")

    version("0.2.0")  # of the folder in which `spack dev-build` runs

    variant("native", default=True, description="All instructions of the processor")
    variant("python", default=True, description="The Python package and its commands")
    variant("tests", default=False, description="Build the tests")

    depends_on("cmake@3.18:", type="build")
    # Modes take SLEPc and MUMPS, stress of sleepers takes ML of Trilinos, run.h5 takes HDF5.
    depends_on("dealii@9.4:+mpi+p4est+hdf5+petsc+slepc+trilinos")
    depends_on("petsc+mumps")
    depends_on("trilinos+ml")
    depends_on("mpi")
    depends_on("fftw@3")
    depends_on("nlohmann-json@3:", type="build")
    depends_on("cli11@2:", type="build")
    depends_on("python@3.9:", type=("build", "run"), when="+python")
    depends_on("py-numpy", type="run", when="+python")
    depends_on("py-matplotlib", type="run", when="+python")
    depends_on("py-h5py", type="run", when="+python")
    conflicts("%gcc@:10", msg="tread is written in C++20")

    def cmake_args(self):
        packages = join_path("lib", f"python{self.spec['python'].version.up_to(2)}", "site-packages") if "+python" in self.spec else ""
        return [
            self.define_from_variant("TREAD_NATIVE", "native"),
            self.define_from_variant("TREAD_TESTS", "tests"),
            self.define("TREAD_BENCHMARKS", False),
            self.define("TREAD_PYTHON_DIR", packages),
            self.define("DEAL_II_DIR", self.spec["dealii"].prefix),
        ]
