"""Figures of the theses whose sweeps docs/sweeps.sh repeats.

Moderno is D. L. Moderno, "Shadow Mapping and Ray-Tracing"; its shares are called as in chain_cases
of sweeps_page.py. Morais is F. da Costa Morais, "Rasterization + Ray Tracing: Rendering of Hard
Shadows".
"""

import io

import pandas as pd


def thesis_table(text: str) -> pd.DataFrame:
    """Figures as they are shown; rows are called by what is in the first column."""
    return pd.read_csv(io.StringIO(text), sep="|", dtype=str, keep_default_na=False, index_col=0)


# Shares, what is best, and Moderno's means and ranges, of the tables with these numbers, recomputed
# from its appendix; those without a number are of its sections 3.6 and 4.9.
MEASURES = thesis_table("""\
measure|share|best|mean|range|table
contour, of the image (here least and most)|contour_pc|least|5.31|1.0 to 11.3|
wrong pixels of the map that it catches, of all of them|caught_pc|most|92.41|57.42 to 100|5
its pixels whose status is wrong|status_pc|least|11.09|1.75 to 31.59|6
hinted by four texels|hinted_pc_TC4|most|58.30|2.39 to 91.06|7
... of those that are lit|hinted_L_pc_TC4|most|58.52|2.42 to 91.70|7
... of those in shadow|hinted_S_pc_TC4|most|57.96|2.37 to 90.15|7
... wrongly, of those that are lit|bad_hints_L_pc_TC4|least|0.55|0 to 2.94|7
... wrongly, of those in shadow|bad_hints_S_pc_TC4|least|0.12|0 to 0.51|7
hinted by nine texels|hinted_pc_TC9|most|43.36|0 to 81.69|8
... wrongly, of those that are lit|bad_hints_L_pc_TC9|least|0.28|0 to 1.32|8
... wrongly, of those in shadow|bad_hints_S_pc_TC9|least|0.02|0 to 0.10|8
its texel alone, the rest lit: wrong|error_pc_ST|least|12.06|3.11 to 24.78|9
... confirmed, of those in shadow|confirmed_pc_ST|most|76.39|52.71 to 93.54|9
... corrected, of those that are lit|corrected_pc_ST|most|0.09|0 to 0.59|9
four texels alone: wrong|error_pc_N4|least|6.39|0.11 to 16.99|10
... confirmed, of those in shadow|confirmed_pc_N4|most|81.03|58.52 to 95.65|10
... corrected, of those that are lit|corrected_pc_N4|most|6.86|0.64 to 29.25|10
nine texels alone: wrong|error_pc_N9|least|5.29|0.05 to 15.17|10
... confirmed, of those in shadow|confirmed_pc_N9|most|82.61|62.77 to 95.74|10
... corrected, of those that are lit|corrected_pc_N9|most|7.50|0.81 to 30.03|10
`edges` alone: wrong|error_pc_A1|least|8.93|1.46 to 21.17|11
... confirmed, of those in shadow|confirmed_pc_A1|most|82.71|64.12 to 96.26|11
`vertices` alone: wrong|error_pc_A2|least|7.19|0.84 to 18.25|11
... confirmed, of those in shadow|confirmed_pc_A2|most|86.19|67.92 to 97.76|11
the chain, settled after nine texels|after_N9_pc|most|75.04|49.09 to 94.27|12
... of those that are lit|after_N9_L_pc|most|65.98|26.97 to 92.50|12
... of those in shadow|after_N9_S_pc|most|84.13|63.03 to 96.77|12
the chain, settled after `vertices`|after_A2_pc|most|76.74|49.52 to 94.68|13
... of those in shadow|after_A2_S_pc|most|87.63|68.07 to 97.78|13
left for rays|left_pc|least|23.26|5.32 to 50.48|
... of those that are lit|left_L_pc|least|34.02|7.50 to 73.03|
... of those in shadow|left_S_pc|least|12.37|2.22 to 31.93|
left for rays, of the image|left_image_pc|least|1.13|0.16 to 2.98|
wrong after the chain and its rays|end_pc|least|0.33|0 to 1.59|14
wrong if what is left is lit|lit_pc|least|2.95|0.02 to 11.25|15
""")

# Moderno's appendix (tables 16 to 199), means over its twelve views
BY_MAP_AND_WIDTH = thesis_table("""\
map, width|plain_pc|contour_pc|caught_pc|status_pc|hinted_pc_TC4|bad_hints_pc_TC4|left_pc|lit_pc
1024, 2|0.754|2.96|76.6 [57 to 92]|19.14|40.73|0.52|34.06|4.91
1024, 4|0.754|5.39|92.8 [82 to 99]|12.65|51.73|0.39|27.34|3.71
1024, 6|0.754|7.51|96.3 [89 to 100]|9.35|60.94|0.34|21.97|2.95
2048, 2|0.428|3.03|92.7 [81 to 99]|12.72|51.75|0.28|26.31|2.84
2048, 4|0.428|5.43|97.6 [92 to 100]|7.35|68.09|0.25|17.22|1.87
2048, 6|0.428|7.54|98.5 [94 to 100]|5.30|76.55|0.22|12.63|1.43
""").join(thesis_table("""\
map, width|error_pc_ST|error_pc_N4|error_pc_N9|error_pc_A1|error_pc_A2|after_N9_pc|after_A2_pc
1024, 2|16.77|9.03|7.66|13.88|11.89|63.63|65.94
1024, 4|13.47|7.59|6.38|10.28|8.38|70.60|72.66
1024, 6|11.72|6.61|5.51|8.40|6.59|76.29|78.03
2048, 2|12.43|6.16|5.03|9.41|7.68|71.86|73.69
2048, 4|9.56|4.80|3.86|6.38|4.81|81.46|82.78
2048, 6|8.39|4.16|3.31|5.25|3.77|86.38|87.37
"""))

# The same, means over three views and three widths
BY_SCENE = thesis_table("""\
scene, map|plain_pc|contour_pc|caught_pc|status_pc|hinted_pc_TC4|bad_of_hints_pc_TC4|left_pc
primitives, 1024|0.25|2.1|88.8 [57 to 100]|11.4|60.1|0.02|24.0
primitives, 2048|0.13|2.1|97.9 [85 to 100]|7.0|70.6|0.02|16.6
bench, 1024|0.74|6.7|91.8 [75 to 99]|11.5|56.9|1.03|23.3
bench, 2048|0.42|6.8|97.6 [94 to 99]|7.0|70.2|0.36|15.5
trees, 1024|0.71|4.6|94.0 [79 to 99]|17.3|31.2|0.01|35.3
trees, 2048|0.36|4.6|98.4 [96 to 99]|9.7|56.8|0.00|22.2
flowers, 1024|1.32|7.7|79.7 [59 to 96]|14.7|56.3|2.05|28.5
flowers, 2048|0.80|7.9|91.2 [81 to 98]|10.2|64.2|1.21|20.7
""")

# What strategies trace and leave wrong, as columns of chain_cases, and Moderno's figures, per cent
# of all pixels of its appendix (the chain with and without hints: 3.6; what is left lit: 4.9)
STRATEGIES = thesis_table("""\
strategy|width|rays|wrong|rays 1024|wrong 1024|rays 2048|wrong 2048
the map alone (`nsm`)|2||plain|0|0.754|0|0.428
`coherence`: rays wherever four texels do not agree|2|rays|wrong_of_rays|3.177|0.056|1.821|0.029
all of the contour of 2 traced|2|N|outside|2.96|0.199|3.03|0.043
all of the contour of 4 traced|4|N|outside|5.39|0.069|5.43|0.016
all of the contour of 6 traced|6|N|outside|7.51|0.038|7.54|0.010
`selective`, contour of 2|2|traced_TC4|wrong_TC4|0.99|0.221|0.78|0.055
`selective`, contour of 4|4|traced_TC4|wrong_TC4|1.46|0.099|0.94|0.035
`selective`, contour of 6|6|traced_TC4|wrong_TC4|1.65|0.072|0.97|0.033
without hints, contour of 2|2|traced_sound|outside|1.62|0.199|1.59|0.043
without hints, contour of 4|4|traced_sound|outside|2.93|0.069|2.83|0.016
without hints, contour of 6|6|traced_sound|outside|4.04|0.038|3.90|0.010
what is left lit, contour of 2|2||wrong_lit|0|0.373|0|0.151
what is left lit, contour of 4|4||wrong_lit|0|0.307|0|0.143
what is left lit, contour of 6|6||wrong_lit|0|0.299|0|0.143
""")

# Moderno's appendix: pixels that are left and lit by their texel, over those in shadow
LEFT_LIT_TO_SHADOW = 2.8

# What Morais traces in pictures and maps of 1024, means over its ten views: tables 17, 18, 75 to 82
TRACED = "`coherence` 20.0 %, `crsm` as published 51.7 %, `crsma` as published 36.7 %"

# In how many of Morais' cases each takes less than its ray tracer alone, and less with twice the
# map, from 1024 on: tables 21 to 25, 84 to 88, 91 to 95 and 98 to 102
LESS_TIME = thesis_table("""\
variant|than rays|with twice the map
coherence|42 of 48|23 of 24
crsm as_published=on|20 of 48|24 of 24
crsma as_published=on|20 of 48|24 of 24
""")
