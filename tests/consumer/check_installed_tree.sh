#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a build tree to a fresh prefix and builds an outside program against it, once with find_package and once with
# pkg-config. Fails when a program needs Ceres at run time or answers wrong values.
# usage: check_installed_tree.sh BUILD_DIR COMPILER
set -euo pipefail
build=$1 compiler=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

fail() { echo "FAILED: $*"; exit 1; }

check_program() {
  local program=$1 libraries
  libraries=$(readelf -d "$program" | grep NEEDED)
  echo "$libraries"
  ! grep -qiE 'ceres|glog|tbb' <<<"$libraries" || fail "$program needs the encoder's libraries"
  LD_LIBRARY_PATH=$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} "$program" || fail "$program"
}

cmake --install "$build" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; fail "install"; }
libdir=$(dirname "$(find "$prefix" -name 'libbrdf_decode.*' | head -n 1)")
# Headers that an include can reach must be there, and nothing of the source tree may be named.
[ -f "$prefix/include/brdf/material.h" ] || fail "headers are not installed"
! grep -rl "$(cd "$here/../.." && pwd)/libbrdf" "$libdir/cmake" "$libdir/pkgconfig" || fail "the files above name the source tree"

echo "== find_package"
cmake -S "$here" -B "$work/cmake" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" >"$work/log" 2>&1 &&
  cmake --build "$work/cmake" >>"$work/log" 2>&1 || { cat "$work/log"; fail "build with find_package"; }
check_program "$work/cmake/consumer"

echo "== pkg-config"
export PKG_CONFIG_PATH=$libdir/pkgconfig
flags=$(pkg-config --cflags --libs brdf-decode)
# shellcheck disable=SC2086  # flags are words
"$compiler" -std=c++20 -O1 "$here/consumer.cpp" -o "$work/consumer" $flags || fail "build with pkg-config"
check_program "$work/consumer"

echo "== command line tools"
for tool in "$build"/bin/*; do
  [ -x "$tool" ] || continue
  installed=$prefix/bin/$(basename "$tool")
  [ -x "$installed" ] || fail "$(basename "$tool") is not installed"
  LD_LIBRARY_PATH=$libdir "$installed" --help >/dev/null || fail "$(basename "$tool") --help"
done
echo "all passed"
