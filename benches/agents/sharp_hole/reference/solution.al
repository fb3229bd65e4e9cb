; A hole with a sharp edge catches the pin only within .4 mm: the step of the search is .02 in, and it has more places.
        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE

        STAGE   "insert it"
        SAVE    ABOVE
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .25 .11
        SKIPN   23
        JUMP    IN
        SAVE    TOUCH
        SEARCH  .02 STEPS 6
        AOJ     L
L:      MOVE    LIFT DIRECT
        RESTORE TOUCH
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .12 .11
        SKIPE   23
        AOJ     L
IN:     CHANGE  [0 0 -1] .56 2
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .35 .3
        HEIGHT  ABOVE -.98 -.78
