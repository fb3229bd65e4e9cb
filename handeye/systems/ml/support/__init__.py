"""The job `support`: the rail support of a typewriter is assembled by touch, from 22 parts."""
