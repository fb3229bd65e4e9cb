"""The job `blocks`: three toy blocks are taken from the table and stacked, by touch."""
