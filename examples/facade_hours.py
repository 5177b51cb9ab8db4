"""A facade's hours of sun on the shortest day of the year, and a picture of its shadow at noon.

python3 facade_hours.py picture.png
"""

import sys

import gnomon

# Metres: x east, y north, z up. The facade looks to the south, where a wall stands.
quad = [(0, 1, 2), (0, 2, 3)]
facade = [(0, 0, 0), (12, 0, 0), (12, 0, 9), (0, 0, 9)], quad
wall = [(5, -9, 0), (8, -9, 0), (8, -9, 6), (5, -9, 6)], quad
ground = [(-3, -12, 0), (15, -12, 0), (15, 0, 0), (-3, 0, 0)], quad
suns, hours = gnomon.sun_path(52.52, 13.405, "2026-12-21", zone=1)
lit = gnomon.hours_lit(facade, suns, hours, casters=wall, samples=256)
print(f"Hours of sun: {lit.mean():.1f} of {hours.sum():.1f}")
gnomon.draw([facade, wall, ground], suns[len(suns) // 2], sys.argv[1])
