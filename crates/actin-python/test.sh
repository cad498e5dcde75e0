#!/usr/bin/env bash
# Tests the Python package: pytest, types, stubs. By default uses the library of the development profile, which
# `cargo test --workspace` shares. With `release`, builds and installs the wheel; with `wheel`, only builds and checks
# it; with `environment`, only installs the tools. All output is below `target`.
set -euo pipefail
cd "$(dirname "$0")/../.."
tools="$PWD/target/tools/python"
wheels="$PWD/target/wheels"
site="$PWD/target/python"
most_bytes=6000000
mode="${1:-}"

python="${PYTHON:-python3}"
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))'
[ -d "$tools" ] || "$python" -m venv "$tools"
bin="$tools/bin"
[ -d "$bin" ] || bin="$tools/Scripts"
if [ "$mode" != wheel ]; then
  "$bin/pip" install --quiet 'numpy>=1.24' pytest mypy pyright nbclient ipykernel matplotlib pandas xarray scipy gsd cosseratbench
  touch "$tools/complete"
fi
echo "environment: $SECONDS s"
[ "$mode" != environment ] || exit 0

SECONDS=0
if [ -n "$mode" ]; then
  "$bin/pip" install --quiet 'maturin>=1.9,<2'
  rm -rf "$wheels"
  "$bin/maturin" build --quiet --release --locked \
    --manifest-path crates/actin-python/Cargo.toml --interpreter "$bin/python" --out "$wheels"
  wheel=$(ls "$wheels"/actin_filaments-*-cp310-abi3-*.whl)
  bytes=$(wc -c < "$wheel")
  echo "wheel: $SECONDS s, $(basename "$wheel"), $bytes bytes"
  [ "$bytes" -lt "$most_bytes" ] || { echo "the wheel has more than $most_bytes bytes"; exit 1; }
  if [ "$(uname)" = Linux ]; then
    "$bin/pip" install --quiet auditwheel
    tag=$("$bin/auditwheel" show "$wheel" | tr '\n' ' ' | grep -o 'platform tag: *"manylinux_[0-9_a-z]*"' | cut -d'"' -f2)
    case "$wheel" in
      *"${tag:-no tag}"*) echo "auditwheel: $tag" ;;
      *) echo "auditwheel allows ${tag:-no manylinux tag}, which is not the tag of the wheel"; exit 1 ;;
    esac
  fi
  [ "$mode" = release ] || exit 0
  "$bin/pip" install --quiet --force-reinstall --no-deps "$wheel"
else
  # Builds the same targets as the tests of the workspace, so that crates have the same features.
  cargo build --quiet --workspace --lib --bins --tests --examples
  rm -rf "$site"
  version=$(cargo pkgid -p actin-python | sed 's/.*[@#]//')
  mkdir -p "$site/actin_filaments-$version.dist-info"
  cp -r crates/actin-python/python/. "$site/"
  cp target/debug/libactin_python.so "$site/actin_filaments/_actin.abi3.so"
  printf 'Metadata-Version: 2.1\nName: actin-filaments\nVersion: %s\n' "$version" > "$site/actin_filaments-$version.dist-info/METADATA"
  printf '[cosseratbench.solvers]\nactin = actin_filaments.cosseratbench:ActinSolver\n' > "$site/actin_filaments-$version.dist-info/entry_points.txt"
  export PYTHONPATH="$site"
fi
echo "library: $SECONDS s"

SECONDS=0
cd crates/actin-python
"$bin/python" -m pytest -q tests
"$bin/python" -m mypy
"$bin/pyright" --pythonpath "$bin/python"
"$bin/python" -m mypy.stubtest actin_filaments._actin --mypy-config-file pyproject.toml
echo "tests: $SECONDS s"
