#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a build tree to a fresh prefix and builds outside programs against it, once with find_package and once with
# pkg-config. Fails when a program of brdf::decode needs Ceres at run time, or when one answers wrong values. A program of
# brdf::client asks the installed brdfd.
# usage: check_installed_tree.sh BUILD_DIR COMPILER
set -euo pipefail
build=$1 compiler=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
daemon=
trap '[ -z "$daemon" ] || kill "$daemon"; rm -rf "$work"' EXIT
prefix=$work/prefix

fail() { echo "FAILED: $*"; exit 1; }

check_decoder() {
  local libraries
  libraries=$(readelf -d "$1" | grep NEEDED)
  echo "$libraries"
  ! grep -qiE 'ceres|glog|tbb' <<<"$libraries" || fail "$1 needs the encoder's libraries"
  "$1" || fail "$1"
}

cmake --install "$build" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; fail "install"; }
libdir=$(dirname "$(find "$prefix" -name 'libbrdf_decode.*' | head -n 1)")
export LD_LIBRARY_PATH=$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
encoder=OFF client=OFF
[ ! -f "$libdir/cmake/brdf/brdf-client-targets.cmake" ] || client=ON
[ -z "$(find "$libdir" -maxdepth 1 -name 'libbrdf.*')" ] || encoder=ON
# The installed files must stand alone.
[ -f "$prefix/include/brdf/material.h" ] || fail "headers are not installed"
! grep -rl "$(cd "$here/../.." && pwd)/libbrdf" "$libdir/cmake" "$libdir/pkgconfig" || fail "the files above name the source tree"

echo "== find_package"
cmake -S "$here" -B "$work/cmake" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCONSUME_ENCODER=$encoder -DCONSUME_CLIENT=$client >"$work/log" 2>&1 &&
  cmake --build "$work/cmake" >>"$work/log" 2>&1 || { cat "$work/log"; fail "build with find_package"; }
check_decoder "$work/cmake/consumer"
[ $encoder = OFF ] || "$work/cmake/encoder_consumer" || fail "encoder_consumer"

if [ $client = ON ]; then
  echo "== client and daemon"
  "$prefix/bin/brdfd" --repository "$here/../../data/golden" --listen "unix:$work/socket" >"$work/ready" 2>"$work/log" &
  daemon=$!
  for _ in $(seq 600); do
    grep -q ready "$work/ready" && break
    kill -0 $daemon || { cat "$work/log"; fail "brdfd"; }
    sleep 0.1
  done
  "$work/cmake/client_consumer" "unix:$work/socket" rgb-lobes || fail "client_consumer"
fi

echo "== pkg-config"
export PKG_CONFIG_PATH=$libdir/pkgconfig
# build_with PACKAGE PROGRAM
build_with() {
  local flags
  flags=$(pkg-config --cflags --libs "$1")
  # shellcheck disable=SC2086  # flags are words
  "$compiler" -std=c++20 -O1 "$here/$2.cpp" -o "$work/$2" $flags || fail "build of $2 with pkg-config"
}
build_with brdf-decode consumer
check_decoder "$work/consumer"
if [ $encoder = ON ]; then
  build_with brdf encoder_consumer
  "$work/encoder_consumer" || fail "encoder_consumer"
fi

echo "== command line tools"
for tool in "$build"/bin/*; do
  [ -x "$tool" ] || continue
  installed=$prefix/bin/$(basename "$tool")
  [ -x "$installed" ] || fail "$(basename "$tool") is not installed"
  "$installed" --help >/dev/null || fail "$(basename "$tool") --help"
done
echo "all passed"
