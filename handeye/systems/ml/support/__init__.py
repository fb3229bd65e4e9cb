"""The job `support`: the rail support of a typewriter, of 22 parts, is assembled by touch."""
