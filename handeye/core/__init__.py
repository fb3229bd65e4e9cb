"""Foundations for all other packages of handeye: units, poses, records, files, errors. It imports none of them."""
