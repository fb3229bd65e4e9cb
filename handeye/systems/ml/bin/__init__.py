"""The job `bin`: bars are taken out of a pile, one at a time, and judged by their width and weight."""
