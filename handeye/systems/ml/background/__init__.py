"""The background level of MOS: the stored program and its interpreter."""
