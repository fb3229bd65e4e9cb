; Exercise `see`: find the base with the camera. `handeye exercise see` explains it.
;
; This program looks once, through the wide lens: enough to see whether something of the size of a base is there.
; Inches, ounces, degrees. The positions are taught, in the file next to this one.

        STAGE   "find the base"
        PARK                    ;out of the picture
        LENS    25
        AIM     BASE
        LOOK    WIDE
        GENERAL BASE WIDE

        STAGE   "go over its web"
        MOVE    OVER
