; set the screwdriver into its rack
        MOVE    D
        CENTER  .5
        CLOSE   .9 1.1
        CHANGE  [0 0 1] 2
        MOVE    DUP
        STOP    (0 0 -20)
        CHANGE  [0 0 -1] .8
        SKIPN   23
        WAIT    "no rack"
        OPEN    1.6
        CHANGE  [0 0 1] 2
        PARK
