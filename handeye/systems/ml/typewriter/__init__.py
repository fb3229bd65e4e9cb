"""The job `typewriter`: a bar is taken out of a bin and oriented, and the rail support is assembled with it."""
