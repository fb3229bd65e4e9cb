; set the block down, where the floor is felt
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        TRANS   PARK [20 30 12 90 90 0]
        OPEN    2
        MOVE    P
        CLOSE   .5
        MOVE    T
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] .8
        OPEN    2
        SKIPN   23
        WAIT    "no floor felt"
        PARK
