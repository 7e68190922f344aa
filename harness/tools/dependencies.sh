#!/bin/sh
# Checks that the packages for a command are installed. Installs missing packages (as root, on Debian), or prints the command that installs them.
# Only .ci/run requires the packages of single tests (chromium, gfortran, octave-cli, python3-vtk9). Without these packages, the tests are skipped.
# usage: dependencies.sh build FLAGS.mk     libraries for the compiler; writes their flags
#        dependencies.sh verify|report|docs|test|truths
#        dependencies.sh deb                 tools that build and check the Debian packages
#        dependencies.sh layout              tools of clang, in the version that both Debian 12 and Debian 13 contain
#        dependencies.sh ci                  tools of `layout`, and all packages without which a test is skipped
set -eu
command=$1
python=${PYTHON:-/usr/bin/python3}
modules= tools= clang="clang-19 clang-format-19 clang-tidy-19"

case $command in
build) ;;
verify) modules="h5py numpy" ;;
report) modules="h5py numpy scipy matplotlib jinja2 markdown yaml" ;;
docs) modules="h5py numpy matplotlib markupsafe sphinx myst_parser:python3-myst-parser furo:furo" ;;
truths) modules="numpy scipy mpmath yaml" ;;
test) modules="h5py numpy scipy matplotlib jinja2 markdown mpmath yaml" ;;
layout) tools=$clang ;;
deb)
    tools="c++:build-essential dpkg-buildpackage:dpkg-dev dh:debhelper doxygen lintian"
    modules="h5py numpy"
    ;;
ci)
    tools="$clang c++:g++ cmake gfortran octave-cli:octave ccx:calculix-ccx sphinx-build:python3-sphinx chromium doxygen mandoc mypy zsh"
    modules="h5py numpy scipy matplotlib jinja2 markdown mpmath yaml pandas myst_parser:python3-myst-parser furo:furo vtk:python3-vtk9 nbclient nbformat ipykernel pip venv:python3-venv"
    ;;
*) echo "dependencies.sh: unknown command '$command'; give build, verify, report, docs, truths, test, deb, layout or ci" >&2; exit 2 ;;
esac

packages=
need() { packages="$packages $1"; }

have_header() { printf '#include <%s>\n' "$1" | ${CC:-cc} -E -I/usr/include/suitesparse -xc - >/dev/null 2>&1; }

can_install() { [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; }

find_libraries() {
    command -v pkg-config >/dev/null 2>&1 || need pkg-config
    have_header stdio.h || need libc6-dev
    have_header gsl/gsl_integration.h || need libgsl-dev
    have_header lapacke.h || need liblapacke-dev
    pkg-config --exists hdf5 2>/dev/null || need libhdf5-dev
    have_header klu.h || need libsuitesparse-dev
    pkg-config --exists yaml-0.1 2>/dev/null || need libyaml-dev
    pkg-config --exists zlib 2>/dev/null || need zlib1g-dev
    pkg-config --exists jansson 2>/dev/null || need libjansson-dev
}

find_missing() {
    packages=
    case $command in build | deb) find_libraries ;; esac
    [ "$command" != ci ] || [ -e /usr/share/bash-completion/bash_completion ] || need bash-completion
    for tool in $tools; do # or tool:package
        command -v "${tool%:*}" >/dev/null 2>&1 || need "${tool#*:}"
    done
    for module in $modules; do # or module:package
        name=${module%:*}
        "$python" -I -c "import importlib.util, sys; sys.exit(importlib.util.find_spec('$name') is None)" >/dev/null 2>&1 ||
            case $module in *:*) need "${module#*:}" ;; *) need "python3-$name" ;; esac
    done
}

install() { # package...
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends -o DPkg::Lock::Timeout=600 "$@" >&2
}

find_missing
if [ -n "$packages" ] && can_install; then
    echo "beamwork: installing$packages" >&2
    apt-get update -q >&2 || true
    # If a package is not available, install the others one by one.
    install $packages || for package in $packages; do install "$package" || true; done
    find_missing
fi
if [ -n "$packages" ]; then
    echo "beamwork: missing$packages. Run: sudo apt-get install$packages" >&2
    exit 1
fi
[ "$command" = build ] || exit 0

flags=$2
libraries="$(pkg-config --libs gsl lapacke hdf5 jansson yaml-0.1 zlib) -lklu -lbtf -lcolamd -lldl -lamd -lsuitesparseconfig -llapack -lblas -lpthread -lm"
mkdir -p "$(dirname "$flags")"

# Shared libraries that take longer to load than most solutions: HDF5 of Debian loads thirty others (curl, Kerberos, ...), and LAPACKE,
# LAPACK and BLAS resolve thousands of symbols. The program uses their static libraries if these link without other libraries.
from_archive() { echo "$1 " | sed "s/ -l$2 / $3 /"; }
links() { # LIBRARIES; the source is standard input
    ${CC:-cc} $(pkg-config --cflags hdf5 lapacke) -xc - -o "$flags.trial" $1 2>/dev/null
    linked=$?
    rm -f "$flags.trial"
    return $linked
}

program=$libraries
trial=$(from_archive "$(pkg-config --libs hdf5 zlib)" hdf5 "-l:libhdf5.a -lsz -ldl")
if printf '%s\n' '#include <hdf5.h>' 'int main(void) {' \
    'hid_t made = H5Pcreate(H5P_DATASET_CREATE), file = H5Fopen("", H5F_ACC_RDONLY, H5P_DEFAULT);' \
    'return H5Pset_deflate(made, 1) < 0 || H5Dread(file, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, 0) < 0; }' |
    links "$trial -lm"; then
    program=$(from_archive "$program" hdf5 "-l:libhdf5.a -lsz -ldl")
fi
solves() { # LIBRARIES of LAPACKE
    printf '%s\n' '#include <lapacke.h>' 'int main(void) { lapack_int pivot; double one = 1;' \
        'return LAPACKE_dgesv(LAPACK_COL_MAJOR, 1, 1, &one, 1, &pivot, &one, 1); }' | links "$1 -lm"
}
if solves "-l:liblapacke.a -llapack -lblas"; then
    program=$(from_archive "$program" lapacke "-l:liblapacke.a")
fi
# The functions of OpenBLAS that the program calls if OpenBLAS is present.
blas="-l:liblapack.a -l:libblas.a -l:libgfortran.so.5"
for name in set_num_threads get_config get_corename; do
    blas="$blas -Wl,-u,openblas_$name,--export-dynamic-symbol=openblas_$name"
done
if solves "-l:liblapacke.a $blas"; then
    program=$(from_archive "$program" "lapack -lblas" "$blas")
fi
{
    echo "DEP_CFLAGS := $(pkg-config --cflags gsl lapacke hdf5 jansson yaml-0.1 zlib | sed 's/-I/-isystem /g') -isystem /usr/include/suitesparse"
    echo "DEP_LIBS := $libraries"
    echo "PROGRAM_LIBS := $program"
} >"$flags.new"
mv "$flags.new" "$flags"
