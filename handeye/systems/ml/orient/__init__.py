"""The job `orient`: the hand takes a bar whose attitude is unknown, and turns it into a known attitude."""
