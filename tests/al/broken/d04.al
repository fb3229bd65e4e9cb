        STAGE   "first pin"
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    T1
        SEARCH  .07
L1:     MOVE    T1
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L1
        OPEN    1

        STAGE   "second pin"
        MOVE    P2
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    T2
        SEARCH  .07
L2:     MOVE    T2
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L1
        OPEN    1
        CHANGE  [0 0 1] 2
        PARK
