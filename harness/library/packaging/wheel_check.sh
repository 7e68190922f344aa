#!/bin/sh
# Installs the wheel and the source distribution in FOLDER into new virtual environments, and uses the module, the program and the
# report. Ends with status 77 if virtual environments or PyPI are not available.
# usage: wheel_check.sh FOLDER
set -eu
folder=$(cd "$1" && pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place"
unset BEAMWORK_LIBRARY BEAMWORK_TRUTHS PYTHONPATH MAKEFLAGS MAKELEVEL

for package in "$folder"/*.whl "$folder"/*.tar.gz; do
    rm -rf new
    /usr/bin/python3 -m venv new >/dev/null 2>&1 || { echo "needs python3-venv"; exit 77; }
    new/bin/pip install -q --disable-pip-version-check numpy >/dev/null 2>&1 || { echo "needs PyPI"; exit 77; }
    new/bin/pip install -q --disable-pip-version-check "$package[report]"
    new/bin/beamwork verify -k "c_column/default and collocation" --shapes -o results.h5 >/dev/null
    new/bin/beamwork-report results.h5 -o site >/dev/null
    test -s site/index.html
    new/bin/python -c '
import beamwork
result = beamwork.Scene.case("c_column").solve("collocation", elements=2)
assert abs(result["buckling_load"] - 12011055.7) < 0.1 and result.errors, result'
    echo "${package##*/}: installed and used"
done
