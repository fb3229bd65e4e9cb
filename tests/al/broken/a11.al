; pin into hole
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    1
        MOVE    P
        CLOSE   .1
L1:     SEARCH  .07             ;look around T
        MOVE    T
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L1
        OPEN    .5
