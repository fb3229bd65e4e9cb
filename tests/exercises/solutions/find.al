
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
        CHANGE  [0 0 -1] .25 .11 ;slowly: the face is .13 below
        SKIPN   23
        JUMP    IN              ;no resistance: it is in the hole
        SAVE    TOUCH           ;where it stands on the face
        SEARCH  .07
        AOJ     L
L:      MOVE    LIFT DIRECT     ;to the next place, .05 over the face
        RESTORE TOUCH
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .12 .11
        SKIPE   23
        AOJ     L
IN:     CHANGE  [0 0 -1] .56 2  ;most of the way, and fast
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .35 .3 ;IT SHOULD MEET SOME RESISTANCE
        HEIGHT  ABOVE -.98 -.78 ;the shoulder stands on the face, .88 below
