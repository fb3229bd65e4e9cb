; Exercise `honest`: report success only if the pin is in its hole. `handeye exercise honest` explains it.
;
; If this program finds no hole, it opens the fingers and ends as if all were well.
; Inches, ounces, degrees. The positions are taught, in the file next to this one.

        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    HOLE

        STAGE   "insert it"
        SAVE    ABOVE           ;how high it begins
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the chamfer guide it
        CHANGE  [0 0 -1] .25 .11
        SKIPN   23
        JUMP    IN              ;no resistance: it is in the hole
        SAVE    TOUCH           ;where it stands on the face
        ASSIGN  TRIES 24
        SEARCH  .07 STEPS 2
        AOJ     L
L:      MOVE    LIFT DIRECT     ;to the next place
        RESTORE TOUCH
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .12 .11
        SKIPN   23
        JUMP    IN
        SOJG    TRIES NEXT
        JUMP    OUT             ;24 places are enough
NEXT:   AOJ     L
IN:     CHANGE  [0 0 -1] .56 2  ;most of the way, and fast
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .35 .3
        SKIPE   23
OUT:    OPEN    1
