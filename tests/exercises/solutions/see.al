        STAGE   "find the base"
        PARK                    ;out of the picture
        LENS    25
        AIM     BASE
        LOOK    WIDE
        GENERAL BASE WIDE       ;about where it is; error 30, and the operator, if nothing is there
        LENS    50
        AIM     BASE            ;where it was seen
        LOOK    NEAR
        SPECIFIC BASE NEAR      ;where, and in which direction; error 31 if the holes do not fit

        STAGE   "go over its web"
        MOVE    OVER
