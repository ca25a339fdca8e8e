"""Settings of line extraction for common laser scanners.

Ranges and errors are the makers' figures: SICK's technical descriptions of the LMS 200 and the
PLS 101, Hokuyo's specification of the UTM-30LX, and ROBOTIS's of the LDS-01. A wall may be as rough
as its noise makes it, and a corner has to stand out from the noise of a few hundred readings.
"""

from dataclasses import replace

from solutions.lines.scan import Settings

# 180 degrees in steps of 0.5 or 1; about 1 cm. The course's own scans are from one of these.
SICK_LMS_200 = Settings()

# As above, but a reading is one of whole steps of 5 cm: an error of up to 2.5 cm, and more noise.
SICK_PLS_101 = replace(Settings(), sigma=0.03, split_distance=0.12, roughness=0.045, min_length=0.8)

# 270 degrees in steps of 0.25, up to 30 m; 1 to 3 cm. With so many beams, a wall has over eight.
HOKUYO_UTM_30LX = replace(
    Settings(), sigma=0.02, split_distance=0.09, roughness=0.03, min_points=16, max_range=30.0
)

# A full turn in steps of 1 degree, up to 3.5 m; 1.5 cm near by, at worst 5 % of the range beyond
# half a metre. It sees rooms rather than halls, whose walls are shorter.
ROBOTIS_LDS_01 = replace(
    Settings(), sigma=0.02, split_distance=0.08, roughness=0.03, min_length=0.4, max_range=3.5
)
