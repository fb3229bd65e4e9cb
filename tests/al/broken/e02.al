        STAGE   "bring the pin"
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    T1
        STAGE   "put it in"
        STOP    [0 0 -50
        CHANGE  [0 0 -1] .6
        SKIPE   23
        WAIT    "the hole is not where it should be"
        OPEN    1
        PARK
