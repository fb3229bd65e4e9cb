"""The job `orient`: a bar that the hand takes in an unknown attitude is turned into a known one."""
