#!/usr/bin/env bash
# Tests the Python package: pytest, types, stubs. By default uses the library of the development profile, which
# `cargo test --workspace` shares. With `release`, builds and installs the wheel. All output is below `target`.
set -euo pipefail
cd "$(dirname "$0")/../.."
tools="$PWD/target/tools/python"
wheels="$PWD/target/wheels"
site="$PWD/target/python"
most_bytes=6000000

python="${PYTHON:-python3}"
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))'
[ -x "$tools/bin/python" ] || "$python" -m venv "$tools"
"$tools/bin/pip" install --quiet 'numpy>=1.24' pytest mypy pyright nbclient ipykernel matplotlib pandas xarray scipy gsd cosseratbench
echo "environment: $SECONDS s"

SECONDS=0
if [ "${1:-}" = release ]; then
  "$tools/bin/pip" install --quiet 'maturin>=1.9,<2'
  rm -rf "$wheels"
  "$tools/bin/maturin" build --quiet --release --locked \
    --manifest-path crates/actin-python/Cargo.toml --interpreter "$tools/bin/python" --out "$wheels"
  wheel=$(ls "$wheels"/actin_filaments-*-cp310-abi3-*.whl)
  bytes=$(wc -c < "$wheel")
  echo "wheel: $SECONDS s, $(basename "$wheel"), $bytes bytes"
  [ "$bytes" -lt "$most_bytes" ] || { echo "the wheel has more than $most_bytes bytes"; exit 1; }
  "$tools/bin/pip" install --quiet --force-reinstall --no-deps "$wheel"
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
"$tools/bin/python" -m pytest -q tests
"$tools/bin/python" -m mypy
"$tools/bin/pyright" --pythonpath "$tools/bin/python"
"$tools/bin/python" -m mypy.stubtest actin_filaments._actin --mypy-config-file pyproject.toml
echo "tests: $SECONDS s"
