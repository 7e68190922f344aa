#!/bin/sh
# Writes pages of the C interfaces. A public declaration without documentation is an error.
# usage: pages.sh VERSION FOLDER
set -eu
cd "$(dirname "$0")/../../../.."
command -v doxygen >/dev/null || { echo "skipped: the pages of the C interfaces need doxygen"; exit 0; }
mkdir -p "$2"
{ cat harness/library/packaging/api/Doxyfile; echo "OUTPUT_DIRECTORY = \"$2\""; echo "PROJECT_NUMBER = $1"; } | doxygen -
