#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the preset "minimal" with every package of the encoder, the tools and the tests hidden: brdf::decode must build,
# install and serve the outside program alone.
# usage: check_minimal_build.sh SOURCE_DIR COMPILER
set -euo pipefail
source=$1 compiler=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

hidden=()
for package in Ceres Eigen3 TBB CLI11 nlohmann_json GTest rapidcheck benchmark OpenEXR; do
  hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
cd "$source"
{ cmake --preset minimal -B "$work/build" -DCMAKE_CXX_COMPILER="$compiler" "${hidden[@]}" &&
  cmake --build "$work/build"; } >"$work/log" 2>&1 || { cat "$work/log"; echo "FAILED: build"; exit 1; }
[ ! -e "$work/build/libbrdf/libbrdf.a" ] || { echo "FAILED: the minimal build made the encoder"; exit 1; }
bash "$here/check_installed_tree.sh" "$work/build" "$compiler"
