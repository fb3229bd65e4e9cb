"""Makes videos of recorded runs. The modules of this package choose moments and views, draw captions, and write the
file formats.
"""
