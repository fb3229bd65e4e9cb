; The search reaches 10 mm. At the end, the pin must meet its shoulder, and it must still be in the hand.
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE
        SAVE    ABOVE
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .25 .11
        SKIPN   23
        JUMP    IN
        SAVE    TOUCH
        SEARCH  .07 STEPS 6
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
