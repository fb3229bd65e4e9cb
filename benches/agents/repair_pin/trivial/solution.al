; One pin into one hole. This program has three mistakes.
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
        SKIPE   23
        JUMP    IN
        SAVE    TOUCH
        SEARCH  .007
        AOJ     L
L:      MOVE    LIFT DIRECT
        RESTORE TOUCH
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .12 .11
        SKIPE   23
        AOJ     L
IN:     STOP    [0 0 -25]
        CHANGE  [0 0 -1] .9 .3
        OPEN    1
