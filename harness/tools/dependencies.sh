#!/bin/sh
# Checks what the build needs, installs what is missing (as root, on Debian),
# or prints the one command that does. Then writes the compiler's flags to $1.
set -eu
flags=$1

packages=
need() { packages="$packages $1"; }

have_header() { printf '#include <%s>\n' "$1" | ${CC:-cc} -E -I/usr/include/suitesparse -xc - >/dev/null 2>&1; }

can_install() { [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; }

find_missing() {
    packages=
    command -v pkg-config >/dev/null 2>&1 || need pkg-config
    have_header stdio.h || need libc6-dev
    have_header gsl/gsl_integration.h || need libgsl-dev
    have_header lapacke.h || need liblapacke-dev
    pkg-config --exists hdf5 2>/dev/null || need libhdf5-dev
    have_header klu.h || need libsuitesparse-dev
    pkg-config --exists arpack 2>/dev/null || need libarpack2-dev
    pkg-config --exists jansson 2>/dev/null || need libjansson-dev
    for pair in h5py:python3-h5py matplotlib:python3-matplotlib jinja2:python3-jinja2 markdown:python3-markdown mpmath:python3-mpmath scipy:python3-scipy; do
        /usr/bin/python3 -c "import ${pair%%:*}" >/dev/null 2>&1 || need "${pair##*:}"
    done
    # One test reads a file with VTK, one opens the report in a browser; both are skipped without.
    if can_install; then
        command -v chromium >/dev/null 2>&1 || need chromium
        /usr/bin/python3 -c "import vtk" >/dev/null 2>&1 || need python3-vtk9
    fi
}

find_missing
if [ -n "$packages" ]; then
    if can_install; then
        echo "beamwork: installing$packages"
        { apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $packages; } >&2
        find_missing
    fi
    if [ -n "$packages" ]; then
        echo "beamwork: missing$packages. Run: sudo apt-get install$packages" >&2
        exit 1
    fi
fi

mkdir -p "$(dirname "$flags")"
{
    echo "DEP_CFLAGS := $(pkg-config --cflags gsl lapacke hdf5 arpack jansson | sed 's/-I/-isystem /g') -isystem /usr/include/suitesparse"
    echo "DEP_LIBS := $(pkg-config --libs gsl lapacke hdf5 arpack jansson) -lklu -lbtf -lcolamd -lldl -lamd -lsuitesparseconfig -llapack -lblas -lpthread -lm"
} >"$flags.new"
mv "$flags.new" "$flags"
