        STAGE   "put on the gasket"
        OPEN    1.9
        MOVE    G
        CLOSE   .7
        CHANGE  [0 0 1] 1
        SEARCH  .05
LG:     MOVE    GON
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] 1.3
        TRAVEL  1.6 2.2         ;a gasket that stands on the pins stops high
        SKIPN   8
        AOJ     LG
        OPEN    1.9
        PARK
