; take the screwdriver out of its rack and hang it up again
        OPEN    .6
        MOVE    D
        CLOSE   .9 1.1
        LOAD    15
        CHANGE  [0 0 1] 2
        MOVE    DUP
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] .8
        LOAD    0
        OPEN    1.6
        CHANGE  [0 0 1] 2
        PARK
