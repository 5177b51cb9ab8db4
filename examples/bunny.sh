#!/bin/bash
# Draws the Stanford bunny on a plane with every technique, compares them with ray tracing, and writes
# the report, on a bare Debian 12 or any machine set up like one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source cmake/debian.sh

install_packages
build release
build/release/bin/gnomon compare bunny -o out/bunny
echo "The report: $PWD/out/bunny/report.html"
