; Macros for one pin and one hole. Inches and ounces.
DEFINE FETCH PART UP
        OPEN    1
        MOVE    PART
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] UP

DEFINE FEEL DOWN OZ
        STOP    [0 0 OZ]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] DOWN .11

DEFINE AGAIN DOWN OZ
        MOVE    LIFT DIRECT
        RESTORE TOUCH
        FEEL    DOWN OZ

DEFINE SEAT DOWN LOW HIGH
        CHANGE  [0 0 -1] .56 2
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] DOWN .3
        HEIGHT  START LOW HIGH

; The end of the macros.
