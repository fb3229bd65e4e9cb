; One pin into one hole. The search gives up early, and the program reports success.
        STAGE   "fetch the pin"
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE

        STAGE   "insert it"
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .25 .11
        SKIPN   23
        JUMP    IN
        SAVE    TOUCH
        SEARCH  .07 STEPS 1
        AOJ     L
L:      SKIPN   6
        JUMP    OUT
        MOVE    LIFT DIRECT
        RESTORE TOUCH
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .12 .11
        SKIPN   23
        JUMP    IN
        AOJ     L
IN:     STOP    [0 0 -25]
        CHANGE  [0 0 -1] .9 .3
OUT:    OPEN    1
